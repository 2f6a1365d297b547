// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/sites.h"
#include "exact/predicates.h"
#include "support/errors.h"

#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace calotte;
using namespace calotte::delaunay_detail;

namespace {

ErrorCode refusal_of(const Points3& points, std::int64_t& index,
                     Duplicates duplicates = Duplicates::merge, double within = 0) {
  const Error error = test::error_of([&] { make_sites(points, duplicates, within); });
  index = error.index();
  return error.code();
}

} // namespace

TEST_CASE("ranks run along the curve and hold every site once, ids keep the order of the input") {
  const Points3 points = random_sphere(30000, 2);
  const Sites sites = make_sites(points, Duplicates::merge, 0);
  REQUIRE(sites.size() == points.cols());
  CHECK(sites.points == points);
  std::vector<bool> seen(static_cast<std::size_t>(sites.size()), false);
  for (std::int64_t r = 0; r < sites.size(); ++r) {
    CHECK((r == 0 || sites.cells.keys()[r - 1] <= sites.cells.keys()[r]));
    const auto id = static_cast<std::size_t>(sites.id[r]);
    CHECK(!seen[id]);
    seen[id] = true;
    CHECK(norm(sites.unit[r] - normalised(sites.given(sites.id[r]))) == 0);
  }
}

TEST_CASE("equal directions of any norm are merged into the lowest index") {
  Points3 points(3, 9);
  points.col(0) << 1, 1, 1;
  points.col(1) << 0, 0, 2;
  points.col(2) << 3, 3, 3;
  points.col(3) << 0x1p600, 0x1p600, 0x1p600;
  points.col(4) << -1, 0, 0;
  points.col(5) << 0, 0, 1e-200;
  points.col(6) << 1, 1, 1 + 0x1p-52; // not equal
  points.col(7) << 0, -1, -0.0;
  points.col(8) << 0, -5, 0.0;
  const Sites sites = make_sites(points, Duplicates::merge, 0);
  CHECK(sites.site_of_input == std::vector<std::int32_t>{0, 1, 0, 0, 2, 1, 3, 4, 4});
  CHECK(sites.size() == 5);
  CHECK(sites.points.col(3) == points.col(6));
  std::int64_t index = -1;
  CHECK(refusal_of(points, index, Duplicates::refuse) == ErrorCode::duplicate);
  CHECK(index == 2);
}

TEST_CASE("ten thousand copies of a few directions, in a cell, are merged") {
  Points3 points = random_sphere(10000, 4);
  for (Eigen::Index i = 100; i < points.cols(); ++i)
    points.col(i) = 2 * points.col(i % 100);
  const Sites sites = make_sites(points, Duplicates::merge, 0);
  CHECK(sites.size() == 100);
  for (std::size_t i = 0; i < 10000; ++i)
    CHECK(sites.site_of_input[i] == static_cast<std::int32_t>(i % 100));
}

TEST_CASE("rounded multiples of one direction are merged where they are exactly equal") {
  Points3 points(3, 600);
  for (Eigen::Index i = 0; i < 600; ++i)
    points.col(i) = (1 + 0.01 * static_cast<double>(i % 300)) * Eigen::Vector3d(0.3, -0.5, 0.7);
  points.rightCols(300) *= 4;
  const Sites sites = make_sites(points, Duplicates::merge, 0);
  const auto given = [&](Eigen::Index i) { return Vec3{points(0, i), points(1, i), points(2, i)}; };
  std::int32_t distinct = 0;
  for (Eigen::Index i = 0; i < 600; ++i) {
    Eigen::Index first = 0;
    while (!same_direction(given(first), given(i)))
      ++first;
    const std::int32_t site = first == i ? distinct++ : sites.site_of_input[first];
    CHECK(sites.site_of_input[i] == site);
  }
  CHECK(distinct > 100);
}

TEST_CASE("ranks run along the curve within a finest cell, too") {
  const std::int64_t n = 20000;
  for (const double width : {1e-9, 1e-11, 1e-13, 1e-200}) {
    CAPTURE(width);
    Points3 points = width * random_sphere(n, 3);
    points.row(0).setOnes();
    const Sites sites = make_sites(points, Duplicates::merge, 0);
    REQUIRE(sites.size() == n);
    double length = 0;
    for (std::int64_t r = 0; r + 1 < n; ++r)
      length += norm(sites.given(sites.id[r + 1]) - sites.given(sites.id[r]));
    CHECK(length < 4 * width * std::sqrt(static_cast<double>(n)));
  }
}

TEST_CASE("merge_within finds the earlier sites of a small crowd, by brute force") {
  Points3 points = 1e-7 * random_sphere(2000, 9);
  points.row(1).setOnes();
  const double within = 3e-9;
  const Sites sites = make_sites(points, Duplicates::merge, within);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < 2000; ++i) {
    const auto near = std::find_if(kept.begin(), kept.end(), [&](Eigen::Index k) {
      return (points.col(k).normalized() - points.col(i).normalized()).norm() < within;
    });
    CHECK(sites.site_of_input[i] == near - kept.begin());
    if (near == kept.end())
      kept.push_back(i);
  }
}

TEST_CASE("merge_within merges into the earlier site that stays, not along chains") {
  const double step = 0.6e-3;
  Points3 points(3, 8);
  for (int i = 0; i < 4; ++i)
    points.col(i) << std::cos(i * step), std::sin(i * step), 0;
  points.col(4) << 0, 0, 1;
  points.col(5) << 0, 0, -1;
  points.col(6) << 0, -1, 0;
  points.col(7) << 7, 0, 0; // site 0 again
  const Sites sites = make_sites(points, Duplicates::merge, 1e-3);
  CHECK(sites.site_of_input == std::vector<std::int32_t>{0, 0, 1, 1, 2, 3, 4, 0});
}

TEST_CASE("bad input is refused with its first offending index") {
  Points3 points = random_sphere(40000, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  points(1, 39000) = nan;
  points.col(20001).setZero();
  std::int64_t index = -1;
  CHECK(refusal_of(points, index) == ErrorCode::zero_vector);
  CHECK(index == 20001);
  points(2, 17) = -infinity;
  CHECK(refusal_of(points, index) == ErrorCode::not_finite);
  CHECK(index == 17);
  CHECK(refusal_of(points.leftCols(2), index) == ErrorCode::too_few_sites);
  CHECK(refusal_of(Points3(3, 0), index) == ErrorCode::too_few_sites);
  Points3 same = Points3::Ones(3, 10);
  CHECK(refusal_of(same, index) == ErrorCode::too_few_sites);
  CHECK(refusal_of(random_sphere(10), index, Duplicates::merge, -1) == ErrorCode::invalid_argument);
  CHECK(refusal_of(random_sphere(10), index, Duplicates::merge, nan) ==
        ErrorCode::invalid_argument);
}
