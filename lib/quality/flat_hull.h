// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

/// Removes flat triangles from the hull of a mesh. Sites on one great circle up to rounding, such
/// as those of a meridian at the border of a mesh, are not on a straight line in exact arithmetic:
/// triangles of width 0 fill the hull there. They are Delaunay, and irrelevant for the quality of
/// the mesh.
namespace calotte::quality_detail {

/// A mesh without flat triangles.
struct WithoutFlatHull {
  Mesh mesh;
  std::vector<std::int32_t> triangle; ///< by triangle of the mesh: its number in the whole mesh
};

/// Removes triangles whose longest side is on the boundary, and less than 1e-14 from the vertex
/// across, repeatedly.
/// \param mesh of unit columns, whose triangles start at their lowest site.
WithoutFlatHull without_flat_hull(Mesh mesh);

} // namespace calotte::quality_detail
