// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace calotte::io_detail {

/// Decodes text in base64 (RFC 4648) piece by piece, and skips white space between the digits.
/// Another text may follow after padding, as where a length and its data are encoded separately.
class Base64Reader {
public:
  explicit Base64Reader(std::string_view text) : rest_(text) {}

  /// Upper bound of the number of bytes that remain.
  std::int64_t most() const;

  /// Appends the next `count` bytes to `out`. Appends fewer if the text ends or has a character
  /// that is not in the alphabet of base64.
  void take(std::int64_t count, std::string& out);

private:
  bool decode_group();

  std::string_view rest_;
  unsigned char group_[3] = {}; ///< decoded bytes
  int begin_ = 0, end_ = 0;     ///< range of bytes in group_ that are not taken yet
};

} // namespace calotte::io_detail
