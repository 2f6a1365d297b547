// SPDX-License-Identifier: GPL-3.0-or-later
#include "memory.h"

#include <doctest/doctest.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>

using namespace calotte::detail;

namespace {

/// Bytes of the process that are in memory.
std::int64_t resident() {
  std::int64_t all = 0, pages = 0;
  std::ifstream("/proc/self/statm") >> all >> pages;
  return pages * sysconf(_SC_PAGESIZE);
}

Array<std::int32_t> filled(std::int64_t n, std::int32_t value) {
  Array<std::int32_t> array(n);
  std::fill(array.begin(), array.end(), value);
  return array;
}

bool holds(const Array<std::int32_t>& array, std::int32_t value) {
  return std::all_of(array.begin(), array.end(), [&](std::int32_t v) { return v == value; });
}

} // namespace

TEST_CASE("give_back() takes an array's pages from the process, and nothing of its neighbours") {
  for (const std::int64_t n : {0, 1, 100, 3000, 100003, 5000000}) { // the last too large for a pool
    INFO(n, " values");
    constexpr std::size_t count = 12;
    std::array<Array<std::int32_t>, count> arrays;
    for (std::size_t i = 0; i < count; ++i)
      arrays[i] = filled(n, static_cast<std::int32_t>(i));
    const std::int64_t before = resident();
    for (std::size_t i = 0; i < count; i += 2)
      give_back(arrays[i]);
    const auto given = static_cast<std::int64_t>(count / 2 * sizeof(std::int32_t)) * n;
    // The system counts roughly, and a sanitizer marks freed memory with an eighth as much.
    CHECK(before - resident() >= given * 3 / 4 - (1 << 20));
    for (std::size_t i = 0; i < count; ++i)
      if (i % 2 == 0)
        CHECK(arrays[i].size() == 0);
      else
        CHECK(holds(arrays[i], static_cast<std::int32_t>(i)));
    CHECK(holds(filled(n, 7), 7));
  }
}
