// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "integrals/half_edge.h"
#include "integrals/room.h"
#include "integrals/rows.h"

#include <array>
#include <cstddef>
#include <vector>

namespace calotte::integrals_detail {

/// A triangle whose circumcentre the stored digits of its corners do not determine.
struct Sliver {
  std::size_t lane;
  std::array<Vec3, 3> side; ///< unit vectors along b - c, c - a and a - b
  std::array<HalfEdge, 3> half;
};

/// Recomputes the rows of slivers, from the directions of their corners without rounding. Slivers
/// are triangles of three sites close together, of two close sites and one far away, or of two
/// nearly antipodal sites. Their circumcentres depend on the last digits of the directions: with
/// rounded corners, the cells of a cluster would overlap.
/// \return the slivers of the batch.
std::vector<Sliver> resolve_slivers(const Batch& batch, TriangleRows& rows);

} // namespace calotte::integrals_detail
