// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "mesh/room.h"

#include <calotte/types.h>

#include <cstdint>

/// Orders of the sites that keep neighbours near each other in memory. An order is the sites as
/// they stand now, in their new places.
namespace calotte::mesh_detail {

/// Along the space-filling curve; sites of one finest cell as they stand. Linear time.
/// \throws Error not_finite, zero_vector.
Array<std::int32_t> curve_order(const Points3& points);

/// Whether in_order(mesh, curve_order(mesh.points)) would be the same mesh. \pre a mesh's ids are
/// in range. Where a point has no direction it says no.
bool is_in_curve_order(const Mesh& mesh);

/// Reverse Cuthill-McKee (Cuthill and McKee, Proc. 24th ACM Conference, 1969): breadth first from
/// the far end of the mesh, those of few neighbours first, then backwards. \pre a mesh's ids are in
/// range.
Array<std::int32_t> reverse_cuthill_mckee_order(const Mesh& mesh);

/// The same mesh with its sites in that order, and its triangles in the canonical order of these:
/// each from its lowest vertex on, sorted by their vertices, triangles of equal vertices as they
/// stand. Linear time. \pre a mesh's ids are in range, the order holds each site once.
Mesh in_order(const Mesh& mesh, const Array<std::int32_t>& order);

} // namespace calotte::mesh_detail
