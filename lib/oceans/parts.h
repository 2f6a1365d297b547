// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oceans/room.h"

#include <calotte/matrices.h>

#include <cstddef>
#include <cstdint>
#include <utility>
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

/// Narrow parts of the sea or of the land, and the wide sites next to each.
struct Narrows {
  Parts parts;
  std::vector<std::vector<std::int32_t>> ends; ///< by part
  std::vector<std::int64_t> sides;             ///< the number of connected groups of its ends
};

/// \param is_narrow(site), is_wide(site) never both.
template <class IsNarrow, class IsWide>
Narrows find_narrows(const IdLists& neighbours, const IsNarrow& is_narrow, const IsWide& is_wide) {
  Narrows narrows{find_parts(neighbours, is_narrow), {}, {}};
  narrows.ends.resize(narrows.parts.sizes.size());
  for (std::int32_t site = 0; site < neighbours.size(); ++site)
    if (const std::int32_t part = narrows.parts.of_cell[site]; part >= 0)
      for (const std::int32_t other : neighbours[site])
        if (is_wide(other))
          narrows.ends[static_cast<std::size_t>(part)].push_back(other);
  std::vector<char> waits(static_cast<std::size_t>(neighbours.size())); // ends to be counted
  const auto take = [&](std::int32_t site) {
    return std::exchange(waits[static_cast<std::size_t>(site)], 0) != 0;
  };
  std::vector<std::int32_t> stack;
  for (const std::vector<std::int32_t>& ends : narrows.ends) {
    for (const std::int32_t site : ends)
      waits[static_cast<std::size_t>(site)] = 1;
    std::int64_t& sides = narrows.sides.emplace_back(0);
    for (const std::int32_t first : ends) {
      if (!take(first))
        continue;
      ++sides;
      for (stack.assign(1, first); !stack.empty();) {
        const std::int32_t site = stack.back();
        stack.pop_back();
        for (const std::int32_t other : neighbours[site])
          if (take(other))
            stack.push_back(other);
      }
    }
  }
  return narrows;
}

} // namespace calotte::oceans_detail
