// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace calotte::io_detail {

/// Rows of ids, 0-based; -1 for a missing one.
struct IdTable {
  std::int64_t width = 0;
  std::vector<std::int32_t> ids;

  std::int64_t rows() const { return width > 0 ? std::ssize(ids) / width : 0; }
  std::int32_t at(std::int64_t row, std::int64_t k) const {
    return ids[static_cast<std::size_t>(row * width + k)];
  }
  bool has(std::int64_t row, std::int32_t id) const {
    const auto begin = ids.begin() + row * width;
    return std::find(begin, begin + width, id) != begin + width;
  }
};

} // namespace calotte::io_detail
