// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/connectivity.h"
#include "mesh/room.h"

#include <cstdint>

namespace calotte::mesh_detail {

/// Divides each triangle in four at the midpoints of its edges. Midpoint e is vertex `points` + e,
/// with the edges in the order of bisect(), see for_each_edge(). Triangle t becomes 4t + i at its
/// vertex i, and 4t + 3 in the middle. Linear time, parallel.
/// \param triangles, neighbours as Mesh's; no two triangles share two edges.
/// \pre points and edges are at most most_points.
Connectivity subdivided(const Triangles& triangles, const Triangles& neighbours,
                        std::int64_t points);

} // namespace calotte::mesh_detail
