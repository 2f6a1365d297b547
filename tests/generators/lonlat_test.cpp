// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/errors.h"

#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

using namespace calotte;

namespace {

Error error_of(const Points2& lonlat) {
  return test::error_of([&] { from_lonlat(lonlat); });
}

} // namespace

TEST_CASE("longitudes and latitudes: exact at multiples of 90 degrees, periodic, one pole") {
  Points2 lonlat(2, 8);
  lonlat << 0, 90, 180, -90, 270, 360, 123, -45, //
      0, 0, 0, 0, 0, 0, 90, -90;
  Points3 expected(3, 8);
  expected << 1, 0, -1, 0, 0, 1, 0, 0, //
      0, 1, 0, -1, -1, 0, 0, 0,        //
      0, 0, 0, 0, 0, 0, 1, -1;
  CHECK(from_lonlat(lonlat) == expected);
  const Points2 there = to_lonlat(random_sphere(100));
  Points2 turned = there;
  turned.row(0).array() = (there.row(0).array() * 1024).round() / 1024; // exact with 360 added
  Points2 again = turned;
  again.row(0).array() += 720;
  CHECK(from_lonlat(turned) == from_lonlat(again));
}

TEST_CASE("longitudes and latitudes there and back, for directions of any norm") {
  const Points3 points = random_sphere(1000, 3);
  const Points2 lonlat = to_lonlat(1e100 * points);
  CHECK(lonlat.row(0).cwiseAbs().maxCoeff() <= 180);
  CHECK(lonlat.row(1).cwiseAbs().maxCoeff() <= 90);
  CHECK((from_lonlat(lonlat) - points).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(to_lonlat(Eigen::Vector3d(0, 0, -2)) == Eigen::Vector2d(0, -90));
  for (const double size : {0x1p-900, 0x1p-400, 0x1p-3, 0x1p700, 0x1p1000})
    CHECK(to_lonlat(size * points.leftCols(100)) == to_lonlat(points.leftCols(100)));
  const Points2 polar = to_lonlat(Eigen::Vector3d(-1e-200, 1e-200, 1));
  CHECK(std::abs(polar(0, 0) - 135) < 1e-13);
  CHECK(polar(1, 0) == 90);
}

TEST_CASE("longitudes and latitudes are those of the C library's functions") {
  constexpr double degrees = 180 / std::numbers::pi;
  const Points3 points = random_sphere(20'000, 8);
  const Points2 places = to_lonlat(points);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double x = points(0, i), y = points(1, i), z = points(2, i);
    CHECK(std::abs(places(0, i) - degrees * std::atan2(y, x)) < 1e-13);
    CHECK(std::abs(places(1, i) - degrees * std::atan2(z, std::hypot(x, y))) < 1e-13);
  }
}

TEST_CASE("longitudes and latitudes out of range name their index") {
  Points2 lonlat = Points2::Zero(2, 5);
  lonlat(1, 3) = 90.5;
  CHECK(error_of(lonlat).code() == ErrorCode::invalid_argument);
  CHECK(error_of(lonlat).index() == 3);
  lonlat(0, 2) = std::numeric_limits<double>::infinity();
  CHECK(error_of(lonlat).code() == ErrorCode::not_finite);
  CHECK(error_of(lonlat).index() == 2);
  CHECK_THROWS_AS(from_lonlat(random_sphere(4)), Error);
  CHECK_THROWS_AS(to_lonlat(Points2::Zero(2, 4)), Error);
}
