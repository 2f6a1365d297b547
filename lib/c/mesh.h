// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "c/guard.h"

#include <calotte/mesh.h>

/// What the opaque pointer of C points to.
struct calotte_mesh {
  calotte::Mesh mesh;
  calotte::Points2 planar_points; ///< x y of the sites in a plane; empty on the sphere
};

namespace calotte::c_detail {

/// \throws Error invalid_argument for a null pointer.
void require_output(calotte_mesh** mesh);

/// Gives a mesh to a caller. \pre require_output(mesh).
void hand_over(Mesh&& made, calotte_mesh** mesh);

/// A caller's mesh. \throws Error invalid_argument for a null pointer.
const Mesh& mesh_of(const calotte_mesh* mesh);

} // namespace calotte::c_detail
