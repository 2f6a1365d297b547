// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/memory.h"

#include <doctest/doctest.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <utility>

using namespace calotte::base_detail;

namespace {

/// Number of the process's bytes that are in memory.
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

TEST_CASE("give_back() returns the pages of an array, and none of its neighbours") {
  for (const std::int64_t n :
       {0, 1, 100, 3000, 100003, 4000000, 5000000}) { // the last is larger than those of the pools
    INFO(n, " values");
    constexpr std::size_t count = 12;
    std::array<Array<std::int32_t>, count> arrays;
    for (std::size_t i = 0; i < count; ++i)
      arrays[i] = filled(n, static_cast<std::int32_t>(i));
    const std::int64_t before = resident();
    for (std::size_t i = 0; i < count; i += 2)
      give_back(arrays[i]);
    // Half: the system counts roughly, and a sanitizer marks freed memory with an eighth of its
    // size.
    if (n >= 4000000)
      CHECK(before - resident() >= static_cast<std::int64_t>(count / 2) * n * 2);
    for (std::size_t i = 0; i < count; ++i)
      if (i % 2 == 0)
        CHECK(arrays[i].size() == 0);
      else
        CHECK(holds(arrays[i], static_cast<std::int32_t>(i)));
    CHECK(holds(filled(n, 7), 7));
  }
}

#ifdef __linux__
TEST_CASE("advise() reaches the whole pages of a block, and no byte beside them") {
  const std::int64_t page = sysconf(_SC_PAGESIZE);
  for (const std::int64_t begin : {std::int64_t{0}, std::int64_t{4}, page - 4, page})
    for (const std::int64_t bytes : {std::int64_t{4}, page - 4, page, 2 * page, 3 * page + 4}) {
      INFO(bytes, " bytes from ", begin, " on");
      Array<char> array(8 * page);
      std::fill(array.begin(), array.end(), 'x');
      const std::int64_t behind = reinterpret_cast<std::intptr_t>(array.begin()) % page;
      char* const first = array.begin() + (page - behind) % page; // a page's
      advise(first + begin, static_cast<std::size_t>(bytes), static_cast<std::size_t>(page),
             MADV_DONTNEED); // leaves zeros
      const std::int64_t from = (begin + page - 1) / page * page,
                         to = std::max(from, (begin + bytes) / page * page);
      CHECK(std::count(array.begin(), array.end(), '\0') == to - from);
      CHECK(std::count(first + from, first + to, '\0') == to - from);
    }
}
#endif

TEST_CASE("an array that was moved from is empty") {
  Array<std::int32_t> from = filled(100, 5);
  const Array<std::int32_t> to = std::move(from);
  CHECK(to.size() == 100);
  CHECK(from.size() == 0);
  give_back(from);
  CHECK(holds(to, 5));
}
