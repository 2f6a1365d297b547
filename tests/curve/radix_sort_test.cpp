// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/radix_sort.h"
#include "delaunay/delaunay.h"

#include "curve/traversal.h"
#include "support/random.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace calotte;
using namespace calotte::curve_detail;

namespace {

/// Keys of few different values, most of them low.
std::vector<std::uint64_t> keys(std::int64_t n, std::uint64_t values, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<std::uint64_t> out(static_cast<std::size_t>(n));
  for (std::uint64_t& key : out) {
    const double x = random.real(0, 1);
    key = static_cast<std::uint64_t>(x * x * static_cast<double>(values));
  }
  return out;
}

} // namespace

TEST_CASE("distribute() sorts by bucket and keeps the order within each") {
  for (const std::int64_t n : {0, 1, 2, 100, 70000, 300000})
    for (const std::int64_t buckets : {1, 2, 63, 64, 65, 4096}) {
      INFO(n, " items, ", buckets, " buckets");
      const std::vector<std::uint64_t> key = keys(n, static_cast<std::uint64_t>(buckets), 7);
      const auto bucket_of = [&](std::int64_t i) { return key[static_cast<std::size_t>(i)]; };
      std::vector<std::int64_t> expected(key.size()), found(key.size(), -1);
      std::iota(expected.begin(), expected.end(), 0);
      std::stable_sort(expected.begin(), expected.end(),
                       [&](std::int64_t i, std::int64_t j) { return bucket_of(i) < bucket_of(j); });
      const std::vector<std::int32_t> first =
          distribute(n, buckets, bucket_of, [&](std::int64_t i, std::int32_t place) {
            found[static_cast<std::size_t>(place)] = i;
          });
      CHECK(found == expected);
      REQUIRE(first.size() == static_cast<std::size_t>(buckets + 1));
      std::vector<std::uint64_t> sorted = key;
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t b = 0; b < first.size(); ++b)
        CHECK(first[b] == std::lower_bound(sorted.begin(), sorted.end(), b) - sorted.begin());
    }
}

TEST_CASE("order_by_key() sorts by key, then item, keys crowded, equal or far apart") {
  constexpr std::uint64_t values = std::uint64_t{1} << 21;
  for (const std::int64_t n : {0, 1, 2, 30, 5000, 70000, 300000})
    for (const int shift : {0, 20, 42}) // the last bits alone, those amid, the first
      for (const std::uint64_t step : {std::uint64_t{1}, values / 100, values}) {
        INFO(n, " items, keys shifted by ", shift, ", multiples of ", step);
        Array<std::uint64_t> key(n);
        std::vector<KeyedItem> expected;
        const std::vector<std::uint64_t> drawn = keys(n, values, 8);
        for (std::int64_t i = 0; i < n; ++i) {
          key[i] = drawn[static_cast<std::size_t>(i)] / step * step << shift;
          expected.push_back({key[i], static_cast<std::int32_t>(i)});
        }
        std::sort(expected.begin(), expected.end(), precedes);
        const Order order = order_by_key(std::move(key));
        REQUIRE(order.size() == n);
        for (std::int64_t k = 0; k < n; ++k) {
          const KeyedItem& e = expected[static_cast<std::size_t>(k)];
          if (order.keys[k] != e.key || order.items[k] != e.item)
            FAIL("place ", k, " holds item ", order.items[k], " instead of ", e.item);
        }
      }
}

namespace {

/// The position of each triangle in the traversal, which visits each once.
std::vector<std::int64_t> turns(const Traversal& way, std::int64_t triangles) {
  std::vector<std::int64_t> turn(static_cast<std::size_t>(triangles), -1);
  for (std::int64_t i = 0; i < triangles; ++i) {
    REQUIRE(way[i] >= 0);
    REQUIRE(way[i] < triangles);
    CHECK(turn[static_cast<std::size_t>(way[i])] == -1);
    turn[static_cast<std::size_t>(way[i])] = i;
  }
  return turn;
}

} // namespace

TEST_CASE("a traversal visits each triangle once, in cells' corners and beyond them too") {
  for (const std::int64_t sites : {4, 5000, 20000})
    for (const int faces : {1, 6}) {
      const std::int64_t triangles = 2 * sites - 4;
      const auto square = [&](std::int64_t t) {
        const double u = static_cast<double>(t % 5 - 2) / 2; // -1 to 1
        return CubePoint{static_cast<int>(t % faces), u, t % 7 == 0 ? 1 + 1e-15 : -u};
      };
      turns(Traversal(triangles, sites, faces, square), triangles);
    }
  turns(Traversal(), 10);
}

TEST_CASE("by a traversal most neighbours are visited soon after each other") {
  const Mesh mesh = delaunay(random_sphere(100000, 9));
  const auto square = [&](std::int64_t t) {
    const auto p = mesh.points.col(mesh.triangles(0, t));
    return to_cube({p[0], p[1], p[2]});
  };
  const std::int64_t triangles = mesh.triangles.cols();
  const std::vector<std::int64_t> turn =
      turns(Traversal(triangles, mesh.points.cols(), 6, square), triangles);
  std::int64_t far = 0;
  for (std::int64_t t = 0; t < triangles; ++t)
    for (int i = 0; i < 3; ++i)
      far += std::abs(turn[static_cast<std::size_t>(t)] -
                      turn[static_cast<std::size_t>(mesh.neighbours(i, t))]) > 16384;
  CHECK(far < triangles / 20);
}

// Slow: a mesh counts as scattered from half a million triangles on.
TEST_CASE("small meshes and those along a curve are not scattered, large ones of random sites are "
          "[slow]") {
  CHECK_FALSE(are_scattered(Triangles(3, 0)));
  CHECK_FALSE(are_scattered(delaunay(random_sphere(70000, 9)).neighbours));
  CHECK_FALSE(are_scattered(delaunay(spiral_sphere(550000)).neighbours));
  CHECK(are_scattered(delaunay(random_sphere(550000, 9)).neighbours));
}
