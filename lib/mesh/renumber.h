// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "mesh/room.h"

#include <calotte/mesh.h>

#include <cstdint>

/// Orders of the sites that keep neighbours near each other in memory. An order lists the current
/// ids of the sites in their new order.
namespace calotte::mesh_detail {

/// The order along the space-filling curve; in a plane, along the curve in the points' bounding
/// box. Sites of one finest cell keep their order. Linear time.
/// \throws Error not_finite, and on the sphere zero_vector.
Array<std::int32_t> curve_order(const Points3& points, const Surface& surface = {});

/// True if in_order(mesh, curve_order(mesh.points)) would not change the mesh; false if a point has
/// no direction.
/// \pre the ids of the mesh are in range.
bool is_in_curve_order(const Mesh& mesh);

/// The same mesh with its sites in that order and its triangles in canonical order: each from its
/// lowest vertex on, sorted by their vertices; triangles of equal vertices keep their order. Linear
/// time.
/// \pre the ids of the mesh are in range; the order contains each site once.
Mesh in_order(const Mesh& mesh, const Array<std::int32_t>& order);

} // namespace calotte::mesh_detail
