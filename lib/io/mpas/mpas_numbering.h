// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "io/cells/deviations.h"
#include "io/mpas/room.h"

#include <calotte/voronoi.h>

#include <cstdint>

/// The free choices of an MPAS file: the numbers of vertices and edges, the starts of the lists
/// around vertices and cells, and the first cell of each edge.
namespace calotte::io_detail {

/// The correspondence of vertices and edges of a file and a tessellation; -1 for none.
struct MpasNumbering {
  Array<std::int32_t> vertex; ///< by vertex of the file: the vertex of the tessellation
  /// By vertex of the file: the index of its cell 0 among the three cells in the tessellation.
  Array<std::int8_t> vertex_start;
  Array<std::int32_t> file_vertex; ///< by vertex of the tessellation: the vertex of the file

  Array<std::int32_t> edge;      ///< by edge of the file: the edge of the tessellation
  Array<std::int32_t> file_edge; ///< by edge of the tessellation: the edge of the file
  Array<std::uint8_t> reversed;  ///< by edge of the tessellation: whether the file reverses it
};

/// Finds vertices and edges by their cells. Adds a deviation if the numbers of vertices or edges
/// differ, if vertices are clockwise, and if edges are not in the mesh or occur twice.
MpasNumbering find_numbering(const Voronoi& voronoi, Deviations& deviations);

} // namespace calotte::io_detail
