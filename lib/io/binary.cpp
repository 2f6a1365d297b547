// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/binary.h"

#include <calotte/error.h>

#include <charconv>

namespace calotte::io_detail {

std::optional<std::int64_t> count_after(std::string_view text, std::string_view key) {
  constexpr std::int64_t largest = std::int64_t{1} << 31;
  const std::size_t place = text.find(key);
  if (place == std::string_view::npos)
    return std::nullopt;
  text.remove_prefix(place + key.size());
  std::int64_t count = -1;
  std::from_chars(text.data(), text.data() + text.size(), count);
  return 0 <= count && count < largest ? std::optional(count) : std::nullopt;
}

std::string_view Bytes::take(std::int64_t size) {
  if (static_cast<std::uint64_t>(size) > rest_.size())
    fail("the file ends early; it is incomplete; make it again");
  const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(size));
  rest_.remove_prefix(taken.size());
  return taken;
}

void Bytes::take(std::string_view expected, const std::string& problem) {
  if (!rest_.starts_with(expected))
    fail(problem);
  rest_.remove_prefix(expected.size());
}

void Bytes::finish() const {
  if (!rest_.empty())
    fail(std::to_string(rest_.size()) + " bytes too many; it is damaged, make it again");
}

void Bytes::fail(const std::string& problem) const {
  throw Error(ErrorCode::parse, name_ + ": " + problem);
}

} // namespace calotte::io_detail
