// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

#include <calotte/coastal_cells.h>
#include <calotte/surface.h>

#include <cstdint>
#include <vector>

/// The parts into which a boundary cuts Voronoi cells.
namespace calotte::voronoi_detail {

/// A side of a cell, counter-clockwise.
struct ClippedSide {
  std::int32_t cell, from, to; ///< the cell, and two vertices
  std::int32_t beyond;         ///< the cell across, or none
};

/// Sorts the sides by cell, then by their first vertex.
/// \returns for each cell where its sides begin, and their number.
std::vector<std::int64_t> sort_sides(std::int64_t cells, std::vector<ClippedSide>& sides);

/// The index of the side of a cell that starts at a vertex; none if there is no such side.
/// \param begin as sort_sides() returns it.
std::int64_t side_from(const std::vector<ClippedSide>& sides,
                       const std::vector<std::int64_t>& begin, std::int32_t cell,
                       std::int32_t vertex);

/// Makes each cell one polygon around its site, see coastal_cells().
/// \param sides of all cells, in any order.
/// \param sites, vertices unit columns; in a plane with z = 0.
/// \returns the counts of parts and islands, and the areas.
CoastChanges join_parts(const Surface& surface, const Points3& sites, const Points3& vertices,
                        std::vector<ClippedSide>& sides);

} // namespace calotte::voronoi_detail
