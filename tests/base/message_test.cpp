// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "base/require.h"
#include "support/errors.h"

#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

namespace calotte::base_detail {
namespace {

TEST_CASE("a message has its values in place") {
  CHECK(message("no value") == "no value");
  CHECK(message("{}", 1) == "1");
  CHECK(message("site {} of {}", std::int64_t{1} << 40, 7U) == "site 1099511627776 of 7");
  CHECK(message("{}{} km", -1.5, std::string("!")) == "-1.5! km");
  CHECK(message("{}, {}", 1.0 / 3, std::numeric_limits<double>::infinity()) == "0.333333, inf");
  CHECK(message("{} is above {}", 90.000001, 90.0) == "90.000001 is above 90");
  CHECK(message("{}, {}, {}", 10000001.0, 1e30, -0.1) == "10000001, 1e+30, -0.1");
  CHECK(message("give [{...}, {}]", "{}") == "give [{...}, {}]"); // no value is a pattern
  CHECK(message("{} {}", std::string_view("{}"), "b") == "{} b");
}

TEST_CASE("words are listed with commas, and another mark before the last") {
  using Words = std::vector<std::string>;
  CHECK(listed(Words{}).empty());
  CHECK(listed(Words{"a"}, " or ") == "a");
  CHECK(listed(Words{"a", "b"}) == "a, b");
  CHECK(listed(std::set<std::string>{"c", "a", "b"}, " or ") == "a, b or c");
  CHECK(listed(Words{"a", "b", "c"}, " or ", " ") == "a b or c");
}

TEST_CASE("a condition says what it required, and no word if it holds") {
  require(true, "{} is not", 1);
  const Error error = test::error_of([] { require(false, "cells is {}; give {}", 3, "more"); });
  CHECK(error.code() == ErrorCode::invalid_argument);
  CHECK(std::string(error.what()) == "cells is 3; give more");
}

TEST_CASE("an index is the first value of its message") {
  const Error error = test::error_of([] { refuse_at(7, "hint {} is {}; give {}", -3, "more"); });
  CHECK(error.code() == ErrorCode::invalid_argument);
  CHECK(error.index() == 7);
  CHECK(std::string(error.what()) == "hint 7 is -3; give more");
}

TEST_CASE("one thing is counted without an s") {
  CHECK(counted(0, "row") == "0 rows");
  CHECK(counted(1, "row") == "1 row");
  CHECK(counted(2, "row") == "2 rows");
}

} // namespace
} // namespace calotte::base_detail
