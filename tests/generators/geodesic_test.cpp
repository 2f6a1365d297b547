// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/errors.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using calotte::test::code_of;

namespace {

using Vector = std::pair<std::int64_t, std::int64_t>;

const std::vector<Vector> vectors{{1, 0}, {1, 1}, {2, 0}, {2, 1}, {1, 2}, {3, 0},
                                  {3, 1}, {2, 2}, {1, 4}, {7, 3}, {5, 5}, {0, 6}};

std::int64_t count_of(std::int64_t b, std::int64_t c) { return 10 * (b * b + b * c + c * c) + 2; }

/// The number of points by their number of neighbours.
std::map<int, std::int64_t> degrees(const Points3& points) {
  const Mesh mesh = delaunay(points);
  REQUIRE(mesh.closed());
  std::vector<int> degree(static_cast<std::size_t>(mesh.points.cols()), 0);
  for (const std::int32_t corner : mesh.triangles.reshaped())
    ++degree[static_cast<std::size_t>(corner)];
  std::map<int, std::int64_t> counts;
  for (const int d : degree)
    ++counts[d];
  return counts;
}

std::map<int, std::int64_t> twelve_fives(std::int64_t n) {
  return n == 12 ? std::map<int, std::int64_t>{{5, 12}}
                 : std::map<int, std::int64_t>{{5, 12}, {6, n - 12}};
}

/// For each point of one set the nearest of the other, and the largest distance.
std::pair<std::set<Eigen::Index>, double> matches(const Points3& points, const Points3& others) {
  std::set<Eigen::Index> nearest;
  double worst = 0;
  for (const auto& point : points.colwise()) {
    Eigen::Index at = 0;
    worst = std::max(worst, (others.colwise() - point).colwise().norm().minCoeff(&at));
    nearest.insert(at);
  }
  return {nearest, worst};
}

/// Whether two sets are one up to rounding.
bool same_set(const Points3& points, const Points3& others) {
  const auto [nearest, worst] = matches(points, others);
  return points.cols() == others.cols() && std::ssize(nearest) == others.cols() && worst < 1e-13;
}

double least_distance(const Points3& points) {
  const Mesh mesh = delaunay(points);
  double least = 2;
  for (const auto& triangle : mesh.triangles.colwise())
    for (int i = 0; i < 3; ++i)
      least = std::min(
          least, (mesh.points.col(triangle[i]) - mesh.points.col(triangle[(i + 1) % 3])).norm());
  return least;
}

} // namespace

TEST_CASE("geodesic: unit points, 12 of five neighbours and all others of six") {
  for (const auto& [b, c] : vectors) {
    CAPTURE(b);
    CAPTURE(c);
    const Points3 points = geodesic_sphere(b, c);
    CHECK(points.cols() == count_of(b, c));
    CHECK((points.colwise().norm().array() - 1).abs().maxCoeff() <= 8 * 0x1p-53);
    CHECK(points.leftCols(12) == bisected_icosahedron(0));
    CHECK(degrees(points) == twelve_fives(count_of(b, c)));
  }
}

TEST_CASE(
    "geodesic: the rotations of the icosahedron are symmetries, a reflection swaps the vector") {
  const Eigen::Vector3d vertex = bisected_icosahedron(0).col(0);
  const Eigen::Matrix3d fifth =
                            Eigen::AngleAxisd(2 * std::numbers::pi / 5, vertex).toRotationMatrix(),
                        third = (Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(),
                        mirror = Eigen::Vector3d(-1, 1, 1).asDiagonal();
  for (const auto& [b, c] : vectors) {
    CAPTURE(b);
    CAPTURE(c);
    const Points3 points = geodesic_sphere(b, c);
    CHECK(same_set(fifth * points, points));
    CHECK(same_set(third * points, points));
    CHECK(same_set(mirror * points, geodesic_sphere(c, b)));
    CHECK(same_set(mirror * points, points) == (b == 0 || c == 0 || b == c));
  }
}

TEST_CASE("geodesic: bisected icosahedra are near to those of a power of two") {
  for (int level = 0; level < 5; ++level) {
    const Points3 points = geodesic_sphere(std::int64_t{1} << level, 0),
                  bisected = bisected_icosahedron(level);
    const auto [nearest, worst] = matches(bisected, points);
    CHECK(std::ssize(nearest) == points.cols());
    CHECK(worst < 0.5 * std::sqrt(4 * std::numbers::pi / static_cast<double>(points.cols())));
  }
}

TEST_CASE("geodesic: any number of points but 13") {
  for (std::int64_t n = 12; n < 700; n = n < 400 ? n + 1 : n + 7)
    if (n != 13) {
      CAPTURE(n);
      const Points3 points = geodesic_sphere(n);
      CHECK(points.cols() == n);
      CHECK(least_distance(points) >=
            0.2 * std::sqrt(4 * std::numbers::pi / static_cast<double>(n)));
      if (n >= 240)
        CHECK(degrees(points) == twelve_fives(n));
    }
  for (const std::int64_t n : {10000, 10250, 12345, 40961, 163000}) {
    CAPTURE(n);
    CHECK(degrees(geodesic_sphere(n)) == twelve_fives(n));
  }
  for (const auto& [b, c] : {Vector{2, 1}, {7, 3}, {8, 0}, {5, 5}}) {
    const Points3 points = geodesic_sphere(count_of(b, c));
    CHECK((same_set(points, geodesic_sphere(b, c)) || same_set(points, geodesic_sphere(c, b))));
  }
}

TEST_CASE("geodesic counts: the nearest within half a percent, bisected icosahedra before others") {
  constexpr std::int64_t most = 60'000;
  std::set<std::int64_t> counts;
  for (std::int64_t b = 1; count_of(b, 0) <= 2 * most; ++b)
    for (std::int64_t c = 0; c <= b; ++c)
      counts.insert(count_of(b, c));
  const std::set<std::int64_t> bisected{12, 42, 162, 642, 2562, 10242, 40962};
  const auto near = [](std::int64_t count, std::int64_t n) {
    return std::abs(static_cast<double>(count - n)) < 0.005 * static_cast<double>(n);
  };
  std::int64_t ties = 0, preferred = 0, own = 0;
  for (std::int64_t n = 12; n <= most; n = n < 3000 ? n + 1 : n + 13) {
    const auto above = counts.lower_bound(n), below = *above == n ? above : std::prev(above);
    std::int64_t expected = n - *below < *above - n ? *below : *above;
    ties += near(expected, n) && n - *below == *above - n && above != below ? 1 : 0;
    own += near(expected, n) ? 0 : 1;
    if (!near(expected, n))
      expected = n;
    for (const std::int64_t level : bisected)
      if (near(level, n)) {
        preferred += expected != level ? 1 : 0;
        expected = level;
      }
    CAPTURE(n);
    CHECK(geodesic_count(static_cast<double>(n)) == expected);
  }
  CHECK(ties > 0);
  CHECK(preferred > 0);
  CHECK(own > 0);
  CHECK(geodesic_count(40904.3) == 40962); // cells of 120 km
  CHECK(geodesic_count(0x1p30) <= (std::int64_t{1} << 30));
}

TEST_CASE("geodesic: numbers out of range are errors") {
  const std::int64_t huge = std::numeric_limits<std::int64_t>::max();
  for (const auto& [b, c] : {Vector{0, 0}, {-1, 2}, {3, -1}, {10363, 1}, {huge, huge}})
    CHECK(code_of([&, b = b, c = c] { geodesic_sphere(b, c); }) == ErrorCode::invalid_argument);
  for (const std::int64_t n :
       {std::int64_t{0}, std::int64_t{11}, std::int64_t{13}, (std::int64_t{1} << 30) + 1, huge})
    CHECK(code_of([&] { geodesic_sphere(n); }) == ErrorCode::invalid_argument);
  for (const double n : {0.0, -5.0, 11.9, 1.1e9, std::nan("")})
    CHECK(code_of([&] { geodesic_count(n); }) == ErrorCode::invalid_argument);
}
