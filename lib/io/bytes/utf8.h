// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

/// Text of files.
namespace calotte::io_detail {

/// Size in bytes of the multi-byte UTF-8 character at the start of a text; 0 if there is none.
inline std::size_t bytes_of_character(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t size = lead >= 0xf0 && lead < 0xf5   ? 4
                           : lead >= 0xe0 && lead < 0xf0 ? 3
                           : lead >= 0xc2 && lead < 0xe0 ? 2
                                                         : 0;
  const auto follows = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
  const bool whole = size > 0 && text.size() >= size &&
                     std::all_of(text.begin() + 1, text.begin() + size, follows);
  return whole ? size : 0;
}

/// Whether all of a text is UTF-8.
inline bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size =
        static_cast<unsigned char>(text[0]) < 0x80 ? 1 : bytes_of_character(text);
    if (size == 0)
      return false;
    text.remove_prefix(size);
  }
  return true;
}

} // namespace calotte::io_detail
