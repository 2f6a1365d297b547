// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/darts.h"

#include "base/points.h"

#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace calotte;
using namespace calotte::cvt_detail;

namespace {

/// Random candidates in a rectangle from the origin. Their keys are those of rows as high as a
/// width.
Candidates candidates_in(double length, double height, std::int64_t n, double width) {
  Points3 corners = random_points(n, rectangle({0, 0}, {length, height}));
  std::vector<std::uint64_t> keys;
  for (const auto& p : corners.colwise())
    keys.push_back(static_cast<std::uint64_t>(p.y() / width) * 1000000 +
                   static_cast<std::uint64_t>(p.x() / width * 100));
  return {std::move(corners), DoubleVector::Constant(n, width), std::move(keys)};
}

double nearest(const Points3& points, const std::vector<std::int64_t>& chosen,
               const Eigen::Vector3d& x, double period = 0) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::int64_t i : chosen)
    for (const double shift : {0.0, -period, period}) {
      const double away = (points.col(i) + Eigen::Vector3d(shift, 0, 0) - x).norm();
      least = away > 0 ? std::min(least, away) : least;
    }
  return least;
}

} // namespace

TEST_CASE("darts: they are apart, keep away from others, and leave no gap") {
  const Candidates in = candidates_in(20, 10, 20000, 1);
  Darts darts(in, Surface::plane());
  const Vec3 other{5, 5, 0};
  darts.put(other, 1);
  // Random discs that leave no room for another cover 0.547 of the plane.
  const std::vector<std::int64_t> few = darts.take(100);
  CHECK(few.size() == 100);
  for (const std::int64_t i : few) {
    CHECK(nearest(in.points, few, in.points.col(i)) >= 0.9);
    CHECK((in.points.col(i) - Eigen::Vector3d(5, 5, 0)).norm() >= 0.9);
  }
  const std::vector<std::int64_t> many = darts.take(230);
  CHECK(many.size() == 230);
  for (const std::int64_t i : many)
    CHECK(nearest(in.points, many, in.points.col(i)) > 0.6);
  for (Eigen::Index i = 0; i < in.points.cols(); ++i)
    if (std::ranges::find(many, i) == many.end())
      CHECK(std::min(nearest(in.points, many, in.points.col(i)),
                     (in.points.col(i) - Eigen::Vector3d(5, 5, 0)).norm()) < 1);
  CHECK(darts.take(1000000).size() == 20000);
  CHECK(darts.take(0).empty());
}

TEST_CASE("darts: a narrow gap between others gets its part of the points") {
  // Between two rows of others 1.8 widths apart there is one row of cells, as wide as they.
  constexpr double length = 60;
  const Candidates in = candidates_in(length, 1.8, 12000, 1);
  Darts darts(in, Surface::plane());
  for (double x = 0; x <= length; ++x) {
    darts.put({x, 0, 0}, 1);
    darts.put({x, 1.8, 0}, 1);
  }
  const auto chosen = darts.take(54);
  CHECK(chosen.size() == 54);
  for (const std::int64_t i : chosen) {
    CHECK(in.points(1, i) > 0.6);
    CHECK(in.points(1, i) < 1.2);
    CHECK(nearest(in.points, chosen, in.points.col(i)) > 0.75);
  }
}

TEST_CASE("darts: of copies in a periodic plane") {
  const Candidates in = candidates_in(10, 10, 5000, 1);
  const Surface box = Surface::periodic({10, 0});
  const std::vector<std::int64_t> chosen = Darts(in, box).take(60);
  for (const std::int64_t i : chosen)
    CHECK(nearest(in.points, chosen, in.points.col(i), 10) >= 0.9);
}
