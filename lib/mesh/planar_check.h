// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/check_laws.h"
#include "mesh/room.h"

#include <calotte/check.h>

namespace calotte::mesh_detail {

/// What check() or check_surface() finds. \pre the mesh is one of the plane.
CheckReport check_in_plane(const Mesh& mesh, Proof proof, const ProgressCallback& progress);

/// As count_edges(). \pre as above.
EdgeCounts count_edges_in_plane(const Mesh& mesh);

} // namespace calotte::mesh_detail
