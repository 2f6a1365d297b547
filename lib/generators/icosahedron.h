// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "generators/room.h"

#include <array>
#include <cstdint>
#include <vector>

namespace calotte::generators_detail {

/// A triangulation with its edges numbered: edge i of a triangle lies across from its vertex i.
struct EdgeMesh {
  using Triple = std::array<std::int32_t, 3>;

  std::vector<std::array<std::int32_t, 2>> edges; ///< vertex ids
  std::vector<Triple> triangles;                  ///< vertex ids, counter-clockwise
  std::vector<Triple> triangle_edges;
};

inline constexpr std::size_t icosahedron_vertices = 12, icosahedron_edges = 30;

/// The unit vertices (0, +-1, +-phi) and their cyclic shifts, normalised.
std::array<Vec3, icosahedron_vertices> icosahedron_points();

/// The 20 faces of the icosahedron.
EdgeMesh icosahedron();

} // namespace calotte::generators_detail
