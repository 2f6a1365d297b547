// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/check_laws.h"
#include "mesh/room.h"

#include <calotte/check.h>

namespace calotte::mesh_detail {

/// The report of check() or check_surface() for a mesh of the plane. \pre the mesh is in a plane.
CheckReport check_in_plane(const Mesh& mesh, Proof proof, const ProgressCallback& progress);

/// count_edges() for a mesh of the plane. \pre as above.
EdgeCounts count_edges_in_plane(const Mesh& mesh);

} // namespace calotte::mesh_detail
