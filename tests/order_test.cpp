// SPDX-License-Identifier: GPL-3.0-or-later
#include "order.h"

#include "itinerary.h"
#include "support/random.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace calotte;
using namespace calotte::detail;

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
      for (std::size_t b = 0; b < first.size(); ++b)
        CHECK(first[b] ==
              std::count_if(key.begin(), key.end(), [&](std::uint64_t k) { return k < b; }));
    }
}

TEST_CASE("sort_by_key() sorts by key, then index, keys crowded or far apart") {
  for (const std::int64_t n : {0, 1, 30, 5000, 300000})
    for (const int bits : {4, 20, 63}) {
      INFO(n, " entries, keys of ", bits, " bits");
      const std::vector<std::uint64_t> key = keys(n, std::uint64_t{1} << 20, 8);
      Array<KeyedIndex> entries(n);
      std::vector<KeyedIndex> expected;
      for (std::int64_t i = 0; i < n; ++i) {
        // Leading bits alone, or together with others; a cube has six faces.
        const std::uint64_t k =
            (key[static_cast<std::size_t>(i)] * 0x9E3779B97F4A7C15U >> (64 - bits)) %
            (std::uint64_t{6} << 60);
        entries[i] = {k, static_cast<std::int32_t>(i)};
        expected.push_back(entries[i]);
      }
      sort_by_key(entries);
      std::sort(expected.begin(), expected.end(), precedes);
      CHECK(std::equal(expected.begin(), expected.end(), entries.begin(),
                       [](const KeyedIndex& a, const KeyedIndex& b) {
                         return a.key == b.key && a.index == b.index;
                       }));
    }
}

TEST_CASE("an itinerary visits each triangle once, neighbours soon after each other [slow]") {
  const Mesh mesh = delaunay(random_sphere(550000, 9));
  REQUIRE(are_scattered(mesh.neighbours));
  const auto square = [&](std::int64_t t) {
    const auto p = mesh.points.col(mesh.triangles(0, t));
    return to_cube({p[0], p[1], p[2]});
  };
  const Itinerary way(mesh.triangles.cols(), mesh.points.cols(), 6, square);
  REQUIRE(way.size() == mesh.triangles.cols());
  std::vector<std::int64_t> turn(static_cast<std::size_t>(way.size()), -1);
  for (std::int64_t i = 0; i < way.size(); ++i) {
    CHECK(turn[static_cast<std::size_t>(way[i])] == -1);
    turn[static_cast<std::size_t>(way[i])] = i;
  }
  std::int64_t far = 0;
  for (std::int64_t t = 0; t < way.size(); ++t)
    for (int i = 0; i < 3; ++i)
      far += std::abs(turn[static_cast<std::size_t>(t)] -
                      turn[static_cast<std::size_t>(mesh.neighbours(i, t))]) > 16384;
  CHECK(far < way.size() / 20);
}

TEST_CASE("small meshes and those along a curve are not scattered [slow]") {
  CHECK_FALSE(are_scattered(delaunay(random_sphere(70000, 9)).neighbours));
  CHECK_FALSE(are_scattered(Triangles(3, 0)));
  CHECK_FALSE(are_scattered(delaunay(spiral_sphere(550000)).neighbours));
}
