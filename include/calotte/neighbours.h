// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/lists.h>
#include <calotte/types.h>

CALOTTE_API_BEGIN
namespace calotte {

/// The neighbours of each site of a mesh: the sites at the other ends of its edges,
/// counter-clockwise around it. Where the triangles surround a site, the list starts with the
/// lowest, as Voronoi::cells_on_cell does; at an open boundary with the one that the boundary leads
/// to, and it ends with the one that the boundary comes from. Of a site where the boundary passes
/// more than once, the lists of its fans of triangles follow each other, by their first triangle.
/// A site in no triangle has none. In a small periodic domain two sites may share more than one
/// edge, and are then neighbours as often. Linear time.
/// \param mesh as delaunay() or read_mesh() returns it; it may be open, and need not be Delaunay.
/// \throws Error invalid_argument for ids out of range, and neighbours that do not match the
///         triangles, with the index of the triangle.
IdLists neighbours(const Mesh& mesh);

} // namespace calotte
CALOTTE_API_END
