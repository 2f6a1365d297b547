// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/errors.h"
#include "support/laws.h"
#include "support/random.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/rotation.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

using LonLat = Eigen::Vector2d;

constexpr double degree = std::numbers::pi / 180;

Eigen::Vector3d at(const LonLat& place) {
  return {std::cos(place[1] * degree) * std::cos(place[0] * degree),
          std::cos(place[1] * degree) * std::sin(place[0] * degree), std::sin(place[1] * degree)};
}

/// Places all over the sphere, with poles and the date line.
std::vector<LonLat> places() {
  Random random(3);
  std::vector<LonLat> all{{0, 0},   {0, 90},   {0, -90},   {137, 90}, {-60, -90},
                          {180, 0}, {-180, 0}, {359, -45}, {90, 1e-9}};
  for (int k = 0; k < 8; ++k)
    all.emplace_back(random.real(-360, 360), random.real(-90, 90));
  return all;
}

/// By rotations about axes: to longitude 0, to the equator, about the point, and on.
Eigen::Matrix3d expected(const LonLat& from, const LonLat& to, double bearing) {
  using Eigen::AngleAxisd;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  return (AngleAxisd(to[0] * degree, z) * AngleAxisd(-to[1] * degree, y) *
          AngleAxisd(-bearing * degree, x) * AngleAxisd(from[1] * degree, y) *
          AngleAxisd(-from[0] * degree, z))
      .toRotationMatrix();
}

Points3 directions(std::int64_t n) {
  Random random(5);
  Points3 points(3, n);
  for (std::int64_t i = 0; i < n; ++i) {
    const base_detail::Vec3 p = random.direction();
    points.col(i) = Eigen::Vector3d(p.x, p.y, p.z).normalized();
  }
  return points;
}

} // namespace

TEST_CASE("a rotation is orthogonal, and that of its angles") {
  for (const LonLat& from : places())
    for (const LonLat& to : places())
      for (const double bearing : {0.0, 30.0, -90.0, 123.456, 720.0}) {
        CAPTURE(from.transpose());
        CAPTURE(to.transpose());
        CAPTURE(bearing);
        const Rotation rotation(from, to, bearing);
        const Eigen::Matrix3d& m = rotation.matrix();
        CHECK((m * m.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 4e-16);
        CHECK(std::abs(m.determinant() - 1) <= 4e-16);
        CHECK((m - expected(from, to, bearing)).cwiseAbs().maxCoeff() <= 4e-15);
        CHECK((rotation(at(from)) - at(to)).norm() <= 1e-15);
      }
}

TEST_CASE("north of the one point lies at the bearing from the other") {
  const Rotation rotation({10, 20}, {-105, 40}, 30);
  const Eigen::Vector3d north = rotation(at({10, 20.001})) - at({-105, 40});
  const Eigen::Vector3d up = at({-105, 40}),
                        east(std::sin(105 * degree), std::cos(105 * degree), 0);
  CHECK(std::atan2(north.dot(east), north.dot(up.cross(east))) / degree ==
        doctest::Approx(30).epsilon(1e-4));
}

TEST_CASE("north at a pole is along the meridian of its longitude") {
  // Northward along 20 E, over the pole, is towards 160 W; at the south pole north is 20 E itself.
  const Rotation pole({20, 90}, {0, 0});
  CHECK((pole(at({-160, 60})) - at({0, 30})).norm() <= 1e-15);
  const Rotation south({20, -90}, {0, 0});
  CHECK((south(at({20, -60})) - at({0, 30})).norm() <= 1e-15);
  const Rotation to_pole({0, 0}, {20, 90});
  CHECK((to_pole(at({0, 30})) - at({-160, 60})).norm() <= 1e-15);
  // Longitudes of a pole turn about it.
  CHECK((Rotation({0, 90}, {30, 90})(at({50, 10})) - at({80, 10})).norm() <= 1e-15);
  CHECK((Rotation({0, 90}, {0, 90}, 30)(at({50, 10})) - at({20, 10})).norm() <= 1e-15);
}

TEST_CASE("rotations that follow each other are one") {
  const std::vector<LonLat> all = places();
  const Points3 points = directions(50);
  for (std::size_t k = 0; k + 2 < all.size(); ++k) {
    const Rotation first(all[k], all[k + 1], 40), second(all[k + 1], all[k + 2], -15),
        both(all[k], all[k + 2], 25);
    CHECK((second(first(points)) - both(points)).cwiseAbs().maxCoeff() <= 1e-15);
  }
}

TEST_CASE("there and back is within two roundings, and norms stay") {
  const Points3 points = directions(40962);
  for (const double bearing : {0.0, 77.7}) {
    const Rotation rotation({12.3, 45.6}, {-78.9, -1.2}, bearing),
        back({-78.9, -1.2}, {12.3, 45.6}, -bearing);
    const Points3 there = rotation(points);
    CHECK((rotation.inverse()(there) - points).cwiseAbs().maxCoeff() <= 3e-16);
    CHECK((back(there) - points).cwiseAbs().maxCoeff() <= 3e-16);
    double worst = 0;
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      worst = std::max(worst, std::abs(there.col(i).norm() / points.col(i).norm() - 1));
    CHECK(worst <= 5e-16);
  }
}

TEST_CASE("norms may be extreme") {
  const Rotation rotation({12.3, 45.6}, {-78.9, -1.2});
  const Eigen::Vector3d direction = directions(1).col(0), rotated = rotation(direction);
  for (const double norm : {1e-200, 1e-90, 6371229.0, 1e90, 1e200})
    CHECK((rotation(Eigen::Vector3d(norm * direction)) / norm - rotated).norm() <= 4e-16);
  CHECK(rotation(Eigen::Vector3d(0, 0, 0)) == Eigen::Vector3d(0, 0, 0));
}

TEST_CASE("equal points and no bearing keep all bits") {
  const Mesh mesh = delaunay(fibonacci_sphere(300));
  for (const LonLat& place : places())
    for (const double bearing : {0.0, 360.0, -720.0}) {
      CAPTURE(place.transpose());
      const Rotation rotation(place, place, bearing);
      CHECK(rotation.is_identity());
      CHECK(identical(rotated(mesh, rotation), mesh));
    }
  CHECK(Rotation({10, 20}, {370, 20}).is_identity());
  CHECK(!Rotation({10, 20}, {10, 20}, 1e-9).is_identity());
  const Eigen::Vector3d zeros(-0.0, 1, -0.0);
  CHECK(same_bits(Points3(Rotation()(zeros)), Points3(zeros)));
}

TEST_CASE("multiples of 90 degrees are exact") {
  const Eigen::Vector3d p(0.1, 0.2, 0.3);
  CHECK(Rotation({0, 0}, {90, 0})(p) == Eigen::Vector3d(-0.2, 0.1, 0.3));
  CHECK(Rotation({0, 0}, {0, 90})(p) == Eigen::Vector3d(-0.3, 0.2, 0.1));
  CHECK(Rotation({0, 0}, {0, 0}, 90)(p) == Eigen::Vector3d(0.1, 0.3, -0.2));
}

TEST_CASE("a point may move to the opposite one") {
  const Rotation rotation({30, 40}, {-150, -40});
  CHECK((rotation(at({30, 40})) + at({30, 40})).norm() <= 1e-15);
  CHECK(Rotation({0, 0}, {180, 0})(Eigen::Vector3d(1, 2, 3)) == Eigen::Vector3d(-1, -2, 3));
}

TEST_CASE("a rotated mesh keeps its ids and is Delaunay, and so are cocircular sites") {
  for (const Mesh& mesh :
       {delaunay(fibonacci_sphere(2000)), delaunay(bisected_icosahedron(4)),
        delaunay(cubed_sphere(12)), delaunay(Points3(fibonacci_sphere(2000).leftCols(700)))}) {
    const Mesh there = rotated(mesh, Rotation({1, 2}, {-105, 40}, 17));
    CHECK(same_bits(there.triangles, mesh.triangles));
    CHECK(same_bits(there.neighbours, mesh.neighbours));
    CHECK(there.site_of_input == mesh.site_of_input);
    CHECK(check_surface(there).passed());
    CHECK(count_edges(there).not_delaunay == 0);
  }
}

TEST_CASE("the rings of a part of the sphere rotate with its mesh") {
  Mesh mesh = delaunay(fibonacci_sphere(100));
  mesh.surface = circle({1, 0, 0}, 0.3);
  const Mesh there = rotated(mesh, Rotation({0, 0}, {50, 60}, 10));
  CHECK(there.surface.contains(at({50, 60})));
  CHECK(!there.surface.contains(at({0, 0})));
  CHECK(there.surface.area() / mesh.surface.area() == doctest::Approx(1).epsilon(1e-13));
}

TEST_CASE("what is no place, and a mesh of a plane, is refused") {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal_of([] {
          Rotation({0, 91}, {0, 0});
        }) ==
        "the point from has the longitude 0 and the latitude 91; give finite degrees, the latitude "
        "from -90 to 90");
  CHECK(refusal_of([&] { Rotation({0, 0}, {none, 0}); }).starts_with("the point to has"));
  CHECK(refusal_of([&] { Rotation({0, 0}, {0, 0}, none); }).starts_with("the bearing is"));
  Mesh plane;
  plane.surface = Surface::plane();
  CHECK(refusal_of([&] { rotated(plane, {}); }).ends_with("give a mesh of the sphere"));
}
