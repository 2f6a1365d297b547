// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

#include <calotte/voronoi.h>

/// Tessellations with a boundary, given as polygons.
namespace calotte::voronoi_detail {

/// Sets the other lists, pairs and triples of ids from vertices_on_cell. Edges between two cells
/// come first, sorted by these; those of one cell follow, in the order of cells. Around a vertex
/// without missing cells the list starts with the lowest.
/// \pre vertices_on_cell is in range; each vertex is on a cell.
/// \throws Error invalid_argument, naming the cell or vertex, for cells that overlap, for a vertex
///         with more than three edges, and for a vertex of two cells only that is not on the
///         boundary.
void connect_open(Voronoi& out);

/// Sets edges, lengths, angles and areas from the cells, the vertices and all ids. Ids may be -1,
/// except those of an edge's first cell, of its vertices, and of the edges and vertices of cells.
/// An edge of one cell has its middle between its vertices, and dc = sqrt(3) dv (MPAS-Tools).
/// \param cut_edges 3 x e: a finite column is the midpoint of an edge of one cell, half way to the
///        missing cell. Default: none.
/// \pre cells and vertices are unit columns; in a plane, z = 0.
void measure_open(Voronoi& out, const Points3& cut_edges = {});

} // namespace calotte::voronoi_detail
