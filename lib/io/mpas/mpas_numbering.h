// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "io/cells/deviations.h"
#include "io/mpas/room.h"

#include <calotte/voronoi.h>

#include <cstdint>

/// The free choices of an MPAS file: how it numbers vertices and edges, where the lists around
/// vertices and cells start, and which cell of an edge comes first.
namespace calotte::io_detail {

/// The vertices and edges of a file among those of a tessellation, and the reverse. -1: none.
struct MpasNumbering {
  Array<std::int32_t> vertex; ///< by vertex of the file: that of the tessellation
  /// By vertex of the file: its cell 0 has this place among the tessellation's three.
  Array<std::int8_t> vertex_start;
  Array<std::int32_t> file_vertex; ///< by vertex of the tessellation

  Array<std::int32_t> edge;      ///< by edge of the file
  Array<std::int32_t> file_edge; ///< by edge of the tessellation
  Array<std::uint8_t> reversed;  ///< by edge of the tessellation: the higher cell comes first
};

/// Finds the vertices by their cells, and the edges by theirs. Adds a deviation where the file's
/// number of vertices or edges is another, where vertices run clockwise, and where edges are none
/// of the mesh or occur twice.
MpasNumbering numbering_of(const Voronoi& voronoi, Deviations& deviations);

} // namespace calotte::io_detail
