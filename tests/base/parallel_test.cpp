// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

using namespace calotte::base_detail;

TEST_CASE("blocks cover all items once, by any number of threads, and add in one order") {
  for (const std::int64_t n : {0, 1, 2047, 2048, 2049, 100'000}) {
    CAPTURE(n);
    std::vector<std::vector<double>> sums;
    for (const int threads : {1, 3}) {
      std::vector<int> calls(static_cast<std::size_t>(n), 0);
      tbb::task_arena(threads).execute([&] {
        for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
          CHECK(block < block_count(n));
          for (std::int64_t i = begin; i != end; ++i)
            ++calls[static_cast<std::size_t>(i)];
        });
        sums.push_back(sums_over_blocks(n, 2, [](Part part, std::span<double> out) {
          for (std::int64_t i = part.begin; i != part.end; ++i) {
            out[0] += 1.0 / static_cast<double>(i + 1);
            out[1] += 1;
          }
        }));
      });
      CHECK(calls == std::vector<int>(static_cast<std::size_t>(n), 1));
    }
    CHECK(sums[0] == sums[1]);
    CHECK(sums[0][1] == static_cast<double>(n));
  }
}

TEST_CASE("each task runs once, and an exception of one reaches the caller") {
  std::vector<int> calls(1000, 0);
  for_each_task(std::ssize(calls), [&](std::int64_t i) { ++calls[static_cast<std::size_t>(i)]; });
  CHECK(calls == std::vector<int>(1000, 1));
  const auto throws_once = [](std::int64_t i) {
    if (i == 500)
      throw std::runtime_error("of task 500");
  };
  CHECK_THROWS_WITH(for_each_task(1000, throws_once), "of task 500");
}

TEST_CASE("a scan replaces values by the sums of those before") {
  std::vector<std::int64_t> values(10'000);
  std::iota(values.begin(), values.end(), 1);
  CHECK(exclusive_scan(std::span(values)) == 50'005'000);
  for (std::int64_t i = 0; i < std::ssize(values); ++i)
    REQUIRE(values[static_cast<std::size_t>(i)] == i * (i + 1) / 2);
}

TEST_CASE("what holds for blocks holds for all of them") {
  const auto all_below = [](std::int64_t bound) {
    return holds_for_blocks(10'000, [=](std::int64_t, std::int64_t end) { return end <= bound; });
  };
  CHECK(all_below(10'000));
  CHECK_FALSE(all_below(9'999));
}
