// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/array.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

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

} // namespace

TEST_CASE("an array that was moved from is empty") {
  Array<std::int32_t> from = filled(100, 5);
  const Array<std::int32_t> to = std::move(from);
  CHECK(to.size() == 100);
  CHECK(from.size() == 0);
  from = {};
  CHECK(holds(to, 5));
}
