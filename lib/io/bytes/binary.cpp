// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/binary.h"

#include "io/bytes/file_error.h"

namespace calotte::io_detail {

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
    fail_file(name_, "{} bytes too many; it is damaged, make it again", rest_.size());
}

void Bytes::fail(const std::string& problem) const { fail_file(name_, problem); }

} // namespace calotte::io_detail
