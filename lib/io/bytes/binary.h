// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace calotte::io_detail {

inline constexpr bool little_endian = std::endian::native == std::endian::little;

/// The unread part of a file's bytes.
class Bytes {
public:
  Bytes(std::string_view bytes, std::string name) : rest_(bytes), name_(std::move(name)) {}

  /// Returns the next `size` bytes.
  /// \throws Error parse if there are fewer.
  std::string_view take(std::int64_t size);

  /// Reads `expected`, or fails with the problem.
  /// \throws Error parse.
  void take(std::string_view expected, const std::string& problem);

  /// \throws Error parse if bytes are left.
  void finish() const;

  [[noreturn]] void fail(const std::string& problem) const;

private:
  std::string_view rest_;
  std::string name_;
};

template <class T> T load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

} // namespace calotte::io_detail
