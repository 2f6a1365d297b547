// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace calotte::io_detail {

/// Decodes text in base64 (RFC 4648) piece by piece. White space between the digits is skipped.
/// After padding another text may follow, as where a length and its data are encoded apart.
class Base64Reader {
public:
  explicit Base64Reader(std::string_view text) : rest_(text) {}

  /// An upper bound of the bytes to come.
  std::int64_t most() const;

  /// Appends the next bytes to `out`, `count` of them, or fewer if the text ends or has a character
  /// that is none of base64.
  void take(std::int64_t count, std::string& out);

private:
  bool decode_group();

  std::string_view rest_;
  unsigned char group_[3] = {}; ///< decoded, but not taken yet
  int begin_ = 0, end_ = 0;     ///< of those
};

} // namespace calotte::io_detail
