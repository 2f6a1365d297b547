// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

#include <calotte/voronoi.h>

#include <cstdint>
#include <vector>

namespace calotte::voronoi_detail {

/// Some cells of the tessellation dual to a mesh.
struct CellPart {
  Voronoi voronoi;
  std::vector<std::int32_t> site; ///< by cell: its site in the mesh, ascending
};

/// The cells of voronoi(mesh, mask). \pre the mesh is valid, with a mask for each site.
CellPart part_of(const Mesh& mesh, const Ids& mask);

} // namespace calotte::voronoi_detail
