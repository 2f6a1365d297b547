// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/room.h"

#include <calotte/mesh.h>

#include <cstdint>

/// The orientations of the triangles of a file.
namespace calotte::mesh_detail {

/// The numbers of triangles of each orientation, exact. Flat triangles count in neither.
struct Orientations {
  std::int64_t counter_clockwise = 0, clockwise = 0;
  std::int64_t first_counter_clockwise = -1, first_clockwise = -1; ///< -1 for none

  bool contradict() const { return counter_clockwise > 0 && clockwise > 0; }
  /// The first triangle of the rarer orientation; in a tie, the first clockwise one.
  std::int64_t first_exception() const {
    return clockwise <= counter_clockwise ? first_clockwise : first_counter_clockwise;
  }
};

/// Counts the orientations of triangles. In a periodic plane a triangle's corners are the nearest
/// copies of its sites.
/// \pre ids are in range; points are directions, or finite ones of the plane within the periods.
Orientations orientations_of(const Points3& points, const Triangles& triangles,
                             const Surface& surface = {});

/// Reverses every triangle: swaps its last two vertices.
void reverse(Triangles& triangles);

/// An edge that more than two triangles share, or that two triangles run through in the same
/// direction: the mesh overlaps itself there.
struct SharedEdge {
  std::int64_t triangle = -1;      ///< the lowest triangle of such an edge; -1 if there is none
  std::int32_t from = -1, to = -1; ///< the edge, as that triangle runs through it
};

/// The first such edge. \param neighbours as neighbours_of() makes them.
SharedEdge first_shared_edge(const Triangles& triangles, const Triangles& neighbours);

} // namespace calotte::mesh_detail
