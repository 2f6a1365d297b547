// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/spherical_triangle.h"

#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace calotte::base_detail;
using calotte::test::Random;

namespace {

constexpr double pi = std::numbers::pi;

Vec3 unit(const Vec3& a) { return (1 / norm(a)) * a; }

} // namespace

TEST_CASE("areas of spherical triangles: octants, their sums, and both ways round") {
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  CHECK(triangle_area(x, y, z) == doctest::Approx(pi / 2).epsilon(1e-15));
  CHECK(triangle_area(x, z, y) == doctest::Approx(-pi / 2).epsilon(1e-15));
  CHECK(triangle_area(x, x, y) == 0);
  CHECK(triangle_area(x, y, y) == 0);
  CHECK(triangle_area(x, y, x) == 0);
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = random.direction(), b = random.direction(), c = random.direction(),
               d = random.direction();
    const double sum = triangle_area(a, b, c) + triangle_area(a, c, d) + triangle_area(a, d, b) +
                       triangle_area(b, d, c); // the faces of a tetrahedron
    CHECK(std::abs(std::remainder(sum, 4 * pi)) < 1e-12);
    CHECK(std::abs(triangle_area(a, b, c) - triangle_area(b, c, a)) < 1e-12);
    CHECK(std::abs(triangle_area(a, b, c) + triangle_area(a, c, b)) < 1e-12);
  }
}

TEST_CASE("areas of small spherical triangles keep their digits") {
  Random random(2);
  for (const double size : {1e-2, 1e-5, 1e-7}) {
    CAPTURE(size);
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 a = random.direction();
      const Vec3 b = unit(a + size * random.direction()), c = unit(a + size * random.direction());
      // The flat triangle in long doubles, of an area within size^2 of the other's.
      const long double px = static_cast<long double>(b.x) - a.x,
                        py = static_cast<long double>(b.y) - a.y,
                        pz = static_cast<long double>(b.z) - a.z,
                        qx = static_cast<long double>(c.x) - a.x,
                        qy = static_cast<long double>(c.y) - a.y,
                        qz = static_cast<long double>(c.z) - a.z;
      const long double flat =
          (a.x * (py * qz - pz * qy) + a.y * (pz * qx - px * qz) + a.z * (px * qy - py * qx)) / 2;
      worst = std::max(worst, std::abs(triangle_area(a, b, c) - static_cast<double>(flat)));
    }
    CHECK(worst < (size * size + 1e-15) * size * size);
  }
}
