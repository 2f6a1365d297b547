// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/room.h"

#include <calotte/mesh.h>

#include <cstdint>

namespace calotte::mesh_detail {

/// A mesh without its points.
struct Connectivity {
  Triangles triangles;  ///< 3 x m vertex ids, counter-clockwise, in any order
  Triangles neighbours; ///< 3 x m, as Mesh's
};

/// Index in a triangle of the vertex across from one of its neighbours.
inline int vertex_across(const Triangles& neighbours, std::int64_t triangle,
                         std::int64_t neighbour) {
  return neighbours(0, triangle) == neighbour ? 0 : neighbours(1, triangle) == neighbour ? 1 : 2;
}

} // namespace calotte::mesh_detail
