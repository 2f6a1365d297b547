// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/deviations.h"
#include "io/cells/id_table.h"
#include "io/mpas/room.h"

#include <calotte/mesh.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <string>
#include <vector>

/// Open MPAS meshes, in which cells are missing.
namespace calotte::io_detail {

/// The lists of an MPAS file. Vertices of cells are in the order of MPAS-Tools, whatever the order
/// in the file.
struct OpenLists {
  std::int64_t cells = 0;
  IdTable cells_on_vertex, edges_on_vertex, cells_on_edge, vertices_on_edge, edges_on_cell,
      vertices_on_cell, cells_on_cell;
  std::vector<std::int32_t> edge_count; ///< by cell
};

/// Reads the lists. Adds a deviation for ids out of range. \returns whether all lists are there.
bool read_open_lists(std::int64_t cells, OpenLists& lists, Deviations& deviations);

/// Adds a deviation for each relation between the lists that is violated.
/// \returns whether none is.
bool check_open_lists(const OpenLists& lists, Deviations& deviations);

} // namespace calotte::io_detail
