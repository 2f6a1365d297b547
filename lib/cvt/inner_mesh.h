// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"

#include <calotte/cvt.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

/// The triangles of a mesh that belong to a bounded surface.
namespace calotte::cvt_detail {

/// The mesh of the triangles between generators only. In a mesh with a hull, generators come first.
Mesh without_hull(Points3&& generators, const Triangles& triangles, const Surface& surface);

/// The part of a mesh that a bounded surface contains, see Boundary. Triangles that touch the
/// others at a site only in a vertex are removed. A mesh in a plane whose boundary clips cells, and
/// one without a boundary, is returned whole.
Mesh inner_mesh(Mesh&& mesh, Boundary boundary);

} // namespace calotte::cvt_detail
