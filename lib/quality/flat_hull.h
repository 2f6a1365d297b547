// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

/// Sites that lie on one great circle but for rounding, such as those on a meridian, are at the
/// border of a mesh no straight line in exact arithmetic: triangles of no width fill its hull
/// there. They are Delaunay, and say nothing of the mesh.
namespace calotte::quality_detail {

/// A mesh without them.
struct WithoutFlatHull {
  Mesh mesh;
  std::vector<std::int32_t> triangle; ///< by triangle of the mesh: its number in the whole one
};

/// Removes triangles whose longest side is on the boundary, and less than 1e-14 from the vertex
/// across, repeatedly.
/// \param mesh of unit columns, whose triangles start at their lowest site.
WithoutFlatHull without_flat_hull(Mesh mesh);

} // namespace calotte::quality_detail
