// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/json_stream.h"

#include "base/message.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"

namespace calotte::io_detail {

JsonBuffer::int_type JsonBuffer::underflow() {
  read_some(in_, bytes_.data(), std::ssize(bytes_), name_);
  const std::streamsize count = in_.gcount();
  if (count == 0)
    return traits_type::eof();
  for (std::streamsize k = 0; k < count; ++k, ++position_)
    check(bytes_[static_cast<std::size_t>(k)]);
  setg(bytes_.data(), bytes_.data(), bytes_.data() + count);
  return traits_type::to_int_type(bytes_[0]);
}

void JsonBuffer::check(char c) {
  if (++length_ > longest)
    fail(message("a number or a text longer than {} bytes", longest));
  if (in_text_) {
    in_text_ = escaped_ || c != '"';
    escaped_ = !escaped_ && c == '\\';
    return;
  }
  switch (c) {
  case '"':
    in_text_ = true;
    length_ = 0;
    break;
  case '[':
  case '{':
    length_ = 0;
    if (++depth_ > deepest)
      fail(message("values nested deeper than {}", deepest));
    break;
  case ']':
  case '}':
    --depth_;
    length_ = 0;
    break;
  case ',':
  case ':':
  case ' ':
  case '\t':
  case '\n':
  case '\r':
    length_ = 0;
    break;
  default:
    break;
  }
}

void JsonBuffer::fail(const std::string& problem) const {
  fail_file(name_, "{} at byte {}; give plain GeoJSON", problem, position_ + 1);
}

} // namespace calotte::io_detail
