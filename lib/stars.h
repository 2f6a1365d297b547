// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "memory.h"
#include "triangle.h"

#include <calotte/types.h>

#include <cstdint>

namespace calotte::detail {

/// A vertex of a triangle: 4 t + v.
using Corner = std::int32_t;
inline std::int32_t triangle_of(Corner corner) { return corner >> 2; }
inline int vertex_of(Corner corner) { return corner & 3; }

/// The corners at each site of a closed mesh, counter-clockwise, from the one whose next vertex is
/// the lowest neighbour on: an order that the triangulation alone determines, whatever its history.
struct Stars {
  Array<std::int32_t> begin; ///< those of site i are at begin[i] to begin[i + 1]
  Array<Corner> corners;
};

Stars make_stars(const Mesh& mesh);

} // namespace calotte::detail
