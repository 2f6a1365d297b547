// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/memory.h"
#include "base/parallel.h"

#include <doctest/doctest.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

using namespace calotte::base_detail;

namespace {

Array<std::int32_t> filled(std::int64_t n, std::int32_t value) {
  Array<std::int32_t> array(n);
  std::fill(array.begin(), array.end(), value);
  return array;
}

bool holds(const Array<std::int32_t>& array, std::int32_t value) {
  return std::all_of(array.begin(), array.end(), [&](std::int32_t v) { return v == value; });
}

constexpr std::size_t megabyte = 1 << 20;

} // namespace

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
  from = {};
  CHECK(holds(to, 5));
}
