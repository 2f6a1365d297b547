// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "mesh/faces.h"
#include "voronoi/room.h"

#include <calotte/voronoi.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace calotte::voronoi_detail {

/// The starts of the sites' lists of triangles.
struct Rings {
  Array<std::int32_t> first;      ///< of each site: the triangle that follows its lowest neighbour
  Array<std::int32_t> first_edge; ///< of the edges of which the site is the lower cell
};

/// The vertex at which edge `index` of a cell starts, counter-clockwise. The edge ends at the
/// vertex of the same index.
inline std::int32_t start_of(const Voronoi& of, std::int64_t cell, std::size_t index) {
  const std::span<const std::int32_t> vertices = of.vertices_on_cell[cell];
  return index == 0 ? vertices.back() : vertices[index - 1];
}

/// The first of two stages that set the ids of the tessellation dual to a closed surface: it sets
/// where the lists of edges_on_cell begin.
/// \pre as many neighbours as triangles; at most 2^29 sites.
/// \throws Error invalid_argument if ids are out of range, the neighbours do not match the
///         triangles, or the triangles at a site do not form one ring.
Rings find_rings(const Faces& surface, Voronoi& out);

/// The second stage: sets the other lists, pairs and triples, except cells_on_vertex, which are the
/// surface's triangles.
/// \throws Error invalid_argument if two cells share two edges.
void connect(const Faces& surface, const Rings& rings, Voronoi& out);

} // namespace calotte::voronoi_detail
