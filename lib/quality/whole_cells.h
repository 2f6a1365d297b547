// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/room.h"

#include <calotte/types.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <vector>

namespace calotte::quality_detail {

/// The cells of an open mesh that triangles surround, as a tessellation with a boundary.
struct WholeCells {
  Voronoi voronoi;
  std::vector<std::int32_t> site; ///< by cell
};

/// \param mesh of unit columns; Delaunay, but for cocircular sites.
/// \throws Error invalid_argument if triangles surround no site.
WholeCells whole_cells(const Mesh& mesh);

} // namespace calotte::quality_detail
