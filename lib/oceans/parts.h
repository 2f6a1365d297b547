// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oceans/room.h"

#include <calotte/matrices.h>

#include <cstdint>
#include <vector>

namespace calotte::oceans_detail {

/// Connected parts of cells.
struct Parts {
  Ids of_cell;                     ///< -1 for a cell in none
  std::vector<std::int64_t> sizes; ///< cells of each

  std::int64_t count() const { return std::ssize(sizes); }
};

/// The parts of the cells that a function selects, in the order of their first cells.
/// \param cells_on_cell neighbours, -1 for a missing one.
template <class IsIn> Parts find_parts(const IdLists& cells_on_cell, const IsIn& is_in) {
  Parts parts{Ids::Constant(cells_on_cell.size(), -1), {}};
  std::vector<std::int32_t> stack;
  for (std::int32_t first = 0; first < cells_on_cell.size(); ++first) {
    if (!is_in(first) || parts.of_cell[first] >= 0)
      continue;
    const auto part = static_cast<std::int32_t>(parts.sizes.size());
    parts.sizes.push_back(0);
    parts.of_cell[first] = part;
    stack.assign(1, first);
    while (!stack.empty()) {
      const std::int32_t cell = stack.back();
      stack.pop_back();
      ++parts.sizes.back();
      for (const std::int32_t other : cells_on_cell[cell])
        if (other >= 0 && is_in(other) && parts.of_cell[other] < 0) {
          parts.of_cell[other] = part;
          stack.push_back(other);
        }
    }
  }
  return parts;
}

} // namespace calotte::oceans_detail
