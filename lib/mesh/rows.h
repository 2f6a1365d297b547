// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/room.h"

#include <calotte/matrices.h>

#include <cstdint>
#include <utility>
#include <vector>

/// Growth by rows: of sites, cells or triangles next to each other.
namespace calotte::mesh_detail {

/// The row after a given one: the ids next to its ids.
/// \param next_to(id) the ids next to an id, as a range.
/// \param take(id) whether to add an id to the new row; called for each id next to one of the given
///        row. It must be true only once for each id.
template <class NextTo, class Take>
std::vector<std::int32_t> next_row(const std::vector<std::int32_t>& row, const NextTo& next_to,
                                   const Take& take) {
  std::vector<std::int32_t> next;
  for (const std::int32_t id : row)
    for (const std::int32_t other : next_to(id))
      if (take(other))
        next.push_back(other);
  return next;
}

/// Marks, extended to the ids within some rows of neighbours.
inline std::vector<std::uint8_t> grown(const IdLists& neighbours, std::vector<std::uint8_t> marks,
                                       int rows) {
  std::vector<std::int32_t> row;
  for (std::int32_t i = 0; i < neighbours.size(); ++i)
    if (marks[static_cast<std::size_t>(i)] != 0)
      row.push_back(i);
  for (; rows > 0; --rows)
    row = next_row(
        row, [&](std::int32_t i) { return neighbours[i]; },
        [&](std::int32_t i) {
          std::uint8_t& mark = marks[static_cast<std::size_t>(i)];
          return std::exchange(mark, std::uint8_t{1}) == 0;
        });
  return marks;
}

} // namespace calotte::mesh_detail
