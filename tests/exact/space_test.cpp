// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/space.h"
#include "support/random.h"

#include <calotte/error.h>
#include <calotte/mesh.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>

using namespace calotte::exact_detail;
using calotte::Points3;
using calotte::Surface;
using calotte::test::Random;

namespace {

const std::array<Plane, 4> planes{Plane(), Plane(Vec2{2, 0}), Plane(Vec2{0, 1.5}),
                                  Plane(Vec2{2, 1.5})};

/// Many are on one line or circle, or half a period apart.
Vec3 coarse(Random& random) {
  return {random.integer(0, 15) / 8.0, random.integer(0, 11) / 8.0, 0};
}

Vec3 fine(Random& random) { return {random.real(0, 2), random.real(0, 1.5), 0}; }

bool same(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

double distance(const Plane& plane, const Image& a, const Image& b) {
  return norm(plane.seen(a, b));
}

} // namespace

TEST_CASE("a surface's space is the sphere, or the plane with its period") {
  CHECK(in_space_of(Surface::sphere(), [](const Space auto& space) { return space.on_sphere; }));
  for (const Eigen::Vector2d& period : {Eigen::Vector2d{2, 0}, Eigen::Vector2d{2, 1.5}})
    in_space_of(Surface::periodic(period), [&](const Space auto& space) {
      CHECK_FALSE(space.on_sphere);
      const Vec3 wrapped = space.wrapped({-0.5, -0.5, 0});
      CHECK(wrapped.x == (space.on_sphere ? -0.5 : 1.5));
      CHECK(wrapped.y == (period.y() > 0 ? 1 : -0.5));
    });
}

TEST_CASE("the copy next to a position is a nearest one, and offsets lead to it") {
  Random random(1);
  for (const Plane& plane : planes)
    for (int round = 0; round < 500; ++round) {
      const Vec3 a = round % 2 == 0 ? coarse(random) : fine(random),
                 b = round % 2 == 0 ? coarse(random) : fine(random);
      const Image here = plane.copy(plane.position(a), random.integer(0, 8)),
                  next = plane.near(b, here);
      CHECK(next.site.x == b.x);
      CHECK(next.site.y == b.y);
      for (int k = 0; k < Plane::copies; ++k)
        CHECK(distance(plane, next, here) <=
              distance(plane, plane.copy(next, k), here) * (1 + 1e-14) + 1e-15);
      CHECK(norm(plane.offset(a, b) - plane.seen(next, here)) <= 1e-14);
      CHECK(same(plane.offset(a, b), -plane.offset(b, a)));
    }
}

TEST_CASE("of two copies that are equally near, it is the one across") {
  const Plane plane(Vec2{2, 1.5});
  Random random(5);
  for (int round = 0; round < 500; ++round) {
    const Vec3 a = coarse(random);
    const int periods = random.integer(-3, 3);
    const Vec3 b{a.x + 1 + 2 * periods, a.y, 0};
    CHECK(same(plane.offset(a, b), Vec3{b.x > a.x ? -1.0 : 1.0, 0, 0}));
    const Image here = plane.copy(plane.position(a), random.integer(0, 8));
    CHECK(same(plane.seen(plane.near(b, here), here), plane.offset(a, b)));
  }
}

TEST_CASE("points have positions up to 2^30 periods away, and no farther") {
  const double far = 0x1p30;
  CHECK(Sphere::has_position({1e300, 0, 0}));
  CHECK(Plane().has_position({1e300, -1e300, 0}));
  for (const double side : {-1.0, 1.0}) {
    const Plane plane(Vec2{0.5, 0});
    const Vec3 x{side * far * 0.5, 1e300, 0}, opposite = -x;
    CHECK(plane.has_position(x));
    CHECK(plane.coordinates(plane.position(x)).x == 0);
    CHECK(plane.coordinates(plane.near(opposite, plane.position(x))).x == 0);
    CHECK_FALSE(plane.has_position({x.x * 1.000001, 0, 0}));
    CHECK_FALSE(plane.has_position({side * std::nan(""), 0, 0}));
    CHECK_FALSE(Plane(Vec2{1e-30, 0}).has_position({side * 1e300, 0, 0}));
  }
  Points3 points = Points3::Zero(3, 5);
  points(1, 3) = 1e12;
  CHECK_NOTHROW(require_positions(Sphere(), points, "site"));
  CHECK_NOTHROW(require_positions(Plane(Vec2{1, 0}), points, "site"));
  CHECK_THROWS_WITH_AS(require_positions(Plane(Vec2{0, 1}), points, "site"),
                       "site 3 is more than 2^30 periods away; give its copy in the box",
                       calotte::Error);
}

TEST_CASE("midpoints have the same bits in either order, are halfway and in the box") {
  Random random(2);
  for (const Plane& plane : planes)
    for (int round = 0; round < 500; ++round) {
      const Vec3 a = round % 2 == 0 ? coarse(random) : fine(random),
                 b = round % 2 == 0 ? coarse(random) : fine(random);
      const Vec3 middle = plane.midpoint(a, b);
      CHECK(same(middle, plane.midpoint(b, a)));
      CHECK(same(middle, plane.wrapped(middle)));
      const double half = norm(plane.offset(a, b)) / 2;
      CHECK(std::abs(norm(plane.offset(a, middle)) - half) <= 1e-14);
      CHECK(std::abs(norm(plane.offset(b, middle)) - half) <= 1e-14);
    }
  for (int round = 0; round < 500; ++round) {
    const Vec3 a = random.direction(), b = random.direction(), middle = Sphere::midpoint(a, 3 * b);
    CHECK(same(middle, Sphere::midpoint(3 * b, a)));
    CHECK(std::abs(norm(middle) - 1) <= 1e-15);
    CHECK(std::abs(norm(a - middle) - norm(b - middle)) <= 1e-14);
  }
}

TEST_CASE("circumcentres are as far from each corner, and areas change sign with orientation") {
  Random random(6);
  const auto check = [](const Space auto& space, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = space.area(a, b, c);
    CHECK(area == doctest::Approx(-space.area(a, c, b)).epsilon(1e-12));
    CHECK(area == doctest::Approx(space.area(b, c, a)).epsilon(1e-12));
    if (area < 0.01) // clockwise, or its circle may be large
      return;
    const Vec3 centre = space.circumcentre(a, b, c);
    CHECK(same(centre, space.wrapped(centre)));
    const double radius = norm(space.offset(centre, a));
    CHECK(std::abs(norm(space.offset(centre, b)) - radius) < 1e-13);
    CHECK(std::abs(norm(space.offset(centre, c)) - radius) < 1e-13);
  };
  for (const Plane& plane : planes)
    for (int round = 0; round < 500; ++round) {
      const Vec3 a = fine(random);
      const auto beside = [&] {
        return plane.wrapped(a + Vec3{random.real(-0.2, 0.2), random.real(-0.2, 0.2), 0});
      };
      check(plane, a, beside(), beside());
    }
  for (int round = 0; round < 500; ++round)
    check(Sphere(), random.direction(), random.direction(), random.direction());
  CHECK(Sphere::area({1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == doctest::Approx(std::acos(-1) / 2));
}

TEST_CASE("filters of copies in a box agree with the exact signs") {
  Random random(3);
  int zeros = 0;
  for (const Plane& plane : planes)
    for (int round = 0; round < 1000; ++round) {
      std::array<Image, 4> p{};
      for (Image& image : p)
        image = plane.copy(plane.position(round % 2 == 0 ? coarse(random) : fine(random)),
                           random.integer(0, 8));
      const Vec2& period = plane.period();
      const int turn = plane.orientation(p[0], p[1], p[2]),
                inside = plane.in_circle(p[0], p[1], p[2], p[3]);
      CHECK(turn == orientation(period, p[0], p[1], p[2]));
      CHECK(turn == -plane.orientation(p[1], p[0], p[2]));
      CHECK(inside == in_circle(period, p[0], p[1], p[2], p[3]));
      CHECK(inside == -plane.in_circle(p[0], p[1], p[3], p[2]));
      zeros += (turn == 0) + (inside == 0);
      if (plane.is_clearly_acute(p[0], p[1], p[2]))
        CHECK(dot(plane.seen(p[1], p[0]), plane.seen(p[2], p[0])) > 0);
    }
  CHECK(zeros > 30);
}

TEST_CASE("resolved circles never say that a site is on them") {
  Random random(4);
  for (const Plane& plane : planes)
    for (int round = 0; round < 300; ++round) {
      const double x = random.integer(0, 7) / 8.0, y = random.integer(0, 5) / 8.0;
      const std::array<Vec3, 4> square{Vec3{x, y, 0}, Vec3{x + 0.5, y, 0},
                                       Vec3{x + 0.5, y + 0.5, 0}, Vec3{x, y + 0.5, 0}};
      std::array<Image, 4> p{};
      p[0] = plane.position(square[0]);
      for (std::size_t k = 1; k < 4; ++k)
        p[k] = plane.near(square[k], p[0]);
      CHECK(plane.in_circle(p[0], p[1], p[2], p[3]) == 0);
      const int sign = plane.in_circle_resolved(p[0], p[1], p[2], p[3]);
      CHECK(sign != 0);
      CHECK(sign == plane.in_circle_resolved(p[1], p[2], p[0], p[3]));
      CHECK(sign == -plane.in_circle_resolved(p[1], p[2], p[3], p[0]));
    }
}
