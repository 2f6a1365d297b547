// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/faces.h"

#include <calotte/matrices.h>

#include <cstdint>
#include <vector>

namespace calotte::mesh_detail {

/// Outer edges of a mesh: 3 t + i is the edge of triangle t across from its vertex i.
using EdgeLoops = Lists<std::vector<std::int64_t>, std::vector<std::int64_t>>;

/// The sites at the start and the end of an outer edge; the mesh is to the left.
inline std::int32_t start_of(const Faces& s, std::int64_t edge) {
  return s.vertex(edge / 3, static_cast<int>(edge % 3) + 1);
}
inline std::int32_t end_of(const Faces& s, std::int64_t edge) {
  return s.vertex(edge / 3, static_cast<int>(edge % 3) + 2);
}

/// The closed loops of outer edges, each from its lowest site on, sorted by the first edge of the
/// lowest triangle. At a site where the boundary passes more than once, a loop turns at the nearest
/// edge around the triangles between them, so that no loop crosses itself.
/// \pre vertices are sites, three in each triangle. Where neighbours do not match the triangles,
///      the edges are those of the fans that match, and a loop may end early.
EdgeLoops edge_loops(const Faces& faces);

} // namespace calotte::mesh_detail
