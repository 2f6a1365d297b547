// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/surface.h>
#include <calotte/voronoi.h>
#include <calotte/widths.h>

#include <cstdint>
#include <vector>

/// The cells of a limited-area grid, and their masks, as MPAS-Atmosphere defines these.
CALOTTE_API_BEGIN
namespace calotte {

/// The rings of boundary cells that MPAS-Atmosphere needs: 5 of relaxation, 2 specified.
inline constexpr int limited_area_rings = 7;

/// Selects the cells of a limited-area grid: those inside, and rings of boundary cells around them.
/// Ring 1 contains the other neighbours of the cells inside, ring k + 1 those of ring k.
///
/// No selected cell has a single selected neighbour, or none: such cells are removed until none is
/// left. In a closed mesh with at least one ring there are none: a cell of ring k has a neighbour
/// in ring k - 1 (in ring 0 for k = 1), and the two cells beside both are neighbours of the latter.
/// Cells are removed from the region itself if there are no rings, and along the boundary of an
/// open mesh.
/// \param cells_on_cell the n cells' 0-based neighbours in any order; -1 for a missing one.
/// \param inside n flags: 1 for the cells of the region, whose generators lie in it; else 0.
/// \param rings number of rings, 0 to limited_area_rings.
/// \returns by cell: 0 inside, 1 to `rings` for the cells of a ring, -1 for cells not selected.
/// \throws Error invalid_argument for rings out of range, if no cell is inside, if all are removed,
///         and if all cells of a closed mesh are selected, so that there is no boundary.
Ids limited_area_mask(const IdLists& cells_on_cell, const std::vector<std::uint8_t>& inside,
                      int rings = limited_area_rings);

/// The mask of edges or vertices: the least mask of the selected cells at each.
/// \param on_cell 0-based edges, or vertices, of each cell; -1 for a missing one.
/// \param mask by cell; -1 for a cell not selected.
/// \param count number of edges, or vertices; all ids are less.
/// \returns by edge or vertex; -1 where no selected cell is.
Ids least_mask(const IdLists& on_cell, const Ids& mask, std::int64_t count);

/// The region that a run meshes for a limited-area grid: the given region, the rings around it and
/// some further cells, so that the outermost ring has whole cells. The whole sphere where that is
/// larger than widened() allows.
/// \param surface a region of the sphere.
/// \param widths of the sphere.
/// \throws Error as widened() and evaluate(); invalid_argument for a plane, and naming a point on
///         the boundary, or within reach of the rings, where no rule gives a width.
Surface with_rings(const Surface& surface, const Widths& widths);

} // namespace calotte
CALOTTE_API_END
