// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/along_boundary.h"

#include "domain/outline.h"
#include "domain/spherical_outline.h"
#include "support/constants.h"
#include "support/directions.h"

#include <calotte/surface.h>

#include <doctest/doctest.h>

#include <cmath>

using namespace calotte;
using namespace calotte::domain_detail;
using calotte::test::degree;

namespace {

/// A square with a hole that a narrow wall parts from its left side.
Surface beside_wall() {
  DoubleMatrix square(2, 4), hole(2, 4);
  square << 0, 4, 4, 0, 0, 0, 4, 4;
  hole << 0.1, 2, 2, 0.1, 1, 1, 3, 3;
  return Surface::plane().within({square, hole});
}

} // namespace

TEST_CASE("along boundary: points slide on it, around blunt corners, and stay at sharp ones") {
  const Surface region = circle(Eigen::Vector3d(1, 2, 3), 20 * degree);
  const SphericalOutline& outline = *outline_of<Sphere>(region);
  Vec3 x = outline.edges().front().from;
  double walked = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 along = along_boundary<Sphere>(outline, x, 1e-3);
    CHECK(std::abs(dot(along, x)) < 1e-3);
    const Vec3 next = slid_on_boundary<Sphere>(outline, x, 0.01 * along, 1e-3);
    CHECK(outline.side(next) != Side::outside);
    double away = 4;
    for (const Arc& edge : outline.edges())
      away = std::min(away, square_from(edge, next));
    CHECK(std::sqrt(away) < 1e-15);
    walked += norm(next - x);
    x = next;
  }
  CHECK(walked / 2 > 0.99);
  CHECK(walked / 2 <= 1 + 1e-12);

  const Surface square = beside_wall();
  const Outline& sides = *outline_of<Plane>(square);
  CHECK(norm(along_boundary<Plane>(sides, {4, 4, 0}, 0.01)) == 0);
  const Vec3 corner = slid_on_boundary<Plane>(sides, {4, 4, 0}, {-0.5, 0, 0}, 0.01);
  CHECK(norm(corner - Vec3{4, 4, 0}) == 0);
  const Vec3 up = slid_on_boundary<Plane>(sides, {4, 3.5, 0}, {0, 2, 0}, 0.01);
  CHECK(norm(up - Vec3{4, 4, 0}) == 0);
}

TEST_CASE("along boundary: points do not leave their side of a narrow wall") {
  const Surface region = beside_wall();
  const Outline& outline = *outline_of<Plane>(region);
  // The left side leads down, and the side of the hole beyond the wall leads up.
  const Vec3 along = along_boundary<Plane>(outline, {0, 2, 0}, 0.2);
  CHECK(norm(along) == 0); // both are within reach
  CHECK(along_boundary<Plane>(outline, {0, 2, 0}, 0.05).y == -1);
  const Vec3 moved = slid_on_boundary<Plane>(outline, {0, 2, 0}, {0.09, -0.1, 0}, 0.05);
  CHECK(moved.x == 0);
  CHECK(moved.y == doctest::Approx(1.9));
}

TEST_CASE("along boundary: a point that rounding has put outside is pushed inside") {
  const Surface region = circle(Eigen::Vector3d(1, 2, 3), 20 * degree);
  const SphericalOutline& outline = *outline_of<Sphere>(region);
  for (const Arc& edge : outline.edges()) {
    const Vec3 middle = normalised(edge.from + edge.to),
               left = normalised(cross(edge.from, edge.to));
    const Vec3 outside = normalised(middle - 0x1p-52 * left);
    const Vec3 x = pushed_inside<Sphere>(outline, outside, left);
    CHECK(outline.side(x) != Side::outside);
    CHECK(norm(x - middle) < 2e-15);
  }
}
