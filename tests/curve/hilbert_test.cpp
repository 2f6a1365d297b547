// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/hilbert.h"
#include "curve/quadtree.h"
#include "exact/predicates.h"

#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace calotte;
using namespace calotte::curve_detail;

namespace {

std::vector<Vec3> directions(std::int64_t n) {
  const Points3 points = random_sphere(n, 11);
  std::vector<Vec3> out;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    out.push_back({points(0, i), points(1, i), points(2, i)});
  for (const double x : {-1.0, 0.0, 1.0}) // the cube's corners, edges and axes
    for (const double y : {-1.0, 0.0, 1.0})
      for (const double z : {-1.0, 0.0, 1.0})
        if (x != 0 || y != 0 || z != 0)
          out.push_back({x, y, z});
  return out;
}

} // namespace

TEST_CASE("central projection onto the cube is inverted by from_cube") {
  for (const Vec3& p : directions(5000)) {
    const CubePoint c = to_cube(p);
    CHECK(std::abs(c.u) <= 1);
    CHECK(std::abs(c.v) <= 1);
    const Vec3 back = normalised(from_cube(c)) - normalised(p);
    CHECK(norm(back) < 1e-15);
  }
}

TEST_CASE("multiples of one direction have one key and the same bits on the cube") {
  std::mt19937_64 random(3);
  for (const Vec3& p : directions(2000)) {
    // Integers times a small integer: both exact.
    const Vec3 q{std::floor(p.x * 0x1p40), std::floor(p.y * 0x1p40), std::floor(p.z * 0x1p40)};
    const double s = 1 + static_cast<double>(random() % 1000);
    const CubePoint a = to_cube(q), b = to_cube(s * q), c = to_cube(0x1p-600 * q);
    CHECK(a.face == b.face);
    CHECK(a.u == b.u);
    CHECK(a.v == b.v);
    CHECK(curve_key(a) == curve_key(b));
    CHECK(curve_key(a) == curve_key(c));
  }
}

TEST_CASE("keys computed together and one by one are equal") {
  const std::vector<Vec3> points = directions(50);
  for (std::int64_t begin = 0; begin < 9; ++begin)
    for (std::int64_t end = begin; end < std::ssize(points); ++end) {
      std::int64_t next = begin;
      const auto square = [&](std::int64_t i) {
        return to_cube(points[static_cast<std::size_t>(i)]);
      };
      for_each_curve_key(begin, end, square, [&](std::int64_t i, std::uint64_t key) {
        CHECK(i == next++);
        CHECK(key == curve_key(square(i)));
      });
      CHECK(next == end);
    }
}

TEST_CASE("keys of vectors in memory are those of their places on the cube") {
  std::vector<Vec3> points = directions(500);
  constexpr double tiny = std::numeric_limits<double>::denorm_min(), huge = 1e307;
  for (const double a : {-huge, -1.0, -tiny, -0.0, 0.0, tiny, 0.5, 1.0, huge})
    for (const double b : {-huge, -1.0, -tiny, -0.0, 0.0, tiny, 0.5, 1.0, huge})
      for (const double c : {-huge, -1.0, -tiny, tiny, 0.5, 1.0, huge})
        points.push_back({a, b, c});
  for (const std::size_t count : {std::size_t{1}, std::size_t{3}, std::size_t{65}, points.size()}) {
    const Vec3* const first = points.data() + points.size() - count;
    std::vector<std::uint64_t> keys(count);
    REQUIRE(set_curve_keys(first, static_cast<std::int64_t>(count), keys.data()));
    for (std::size_t i = 0; i < count; ++i)
      REQUIRE(keys[i] == curve_key(to_cube(first[i])));
  }
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const Vec3& bad : {Vec3{0, 0, 0}, Vec3{0, -0.0, 0}, Vec3{nan, 1, 0}, Vec3{1, nan, 0},
                          Vec3{0, 0, nan}, Vec3{infinity, 0, 0}, Vec3{1, 0, -infinity},
                          Vec3{infinity, infinity, infinity}, Vec3{1.7e308, 1.7e308, 0}}) {
    points[70] = bad;
    std::vector<std::uint64_t> keys(points.size());
    CHECK(!set_curve_keys(points.data(), std::ssize(points), keys.data()));
  }
}

TEST_CASE("steps of the curve go to neighbouring cells, from face to face too") {
  // All cells of a coarse level in curve order, by their middle points.
  constexpr int level = 5, cells = 1 << level;
  std::vector<std::pair<std::uint64_t, Vec3>> middles;
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) {
        const CubePoint c{face, (2.0 * i + 1) / cells - 1, (2.0 * j + 1) / cells - 1};
        middles.emplace_back(curve_key(c), from_cube(c));
      }
  std::sort(middles.begin(), middles.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t m = 1; m < middles.size(); ++m)
    CHECK(norm(middles[m].second - middles[m - 1].second) < 2.0 / cells + 1e-12);
}

TEST_CASE("the cells of each level partition the sites, and their balls contain them") {
  std::vector<std::pair<std::uint64_t, Vec3>> sites;
  for (const Vec3& p : directions(3000))
    sites.emplace_back(curve_key(to_cube(p)), normalised(p));
  std::sort(sites.begin(), sites.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  Array<std::uint64_t> keys(std::ssize(sites));
  for (std::int64_t r = 0; r < keys.size(); ++r)
    keys[r] = sites[static_cast<std::size_t>(r)].first;

  const Quadtree tree(std::move(keys));
  const auto faces = tree.faces();
  std::vector<QuadtreeCell> cells(faces.begin(), faces.end());
  for (int level = 0; level < 12; ++level) {
    std::int64_t next = 0;
    std::vector<QuadtreeCell> below;
    for (const QuadtreeCell& cell : cells) {
      CHECK(cell.begin == next);
      CHECK(cell.level == level);
      next = cell.end;
      const Ball ball = bounding_ball(cell);
      for (std::int64_t r = cell.begin; r != cell.end; ++r)
        CHECK(norm(sites[static_cast<std::size_t>(r)].second - ball.centre) <= ball.radius);
      if (cell.size() == 0)
        continue;
      for (const QuadtreeCell& child : tree.children(cell))
        below.push_back(child);
    }
    CHECK(next == tree.size());
    cells = below;
  }
}
