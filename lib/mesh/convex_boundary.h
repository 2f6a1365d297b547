// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/room.h"

#include <calotte/mesh.h>

namespace calotte::mesh_detail {

/// Whether the boundary of a mesh of the plane is one convex ring, as that of the triangulation of
/// all its points is. Exact.
/// \pre triangles do not overlap.
bool is_convex(const Mesh& mesh);

} // namespace calotte::mesh_detail
