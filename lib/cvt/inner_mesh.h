// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"

#include <calotte/cvt.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

/// The triangles of a mesh that belong to a bounded surface.
namespace calotte::cvt_detail {

/// The mesh of the triangles between generators only, which come first in a mesh with a hull.
Mesh without_hull(Points3&& generators, const Triangles& triangles, const Surface& surface);

/// The part of a mesh that a bounded surface contains, see Boundary: without triangles that touch
/// the others at a site in a vertex only. All of a mesh in a plane whose boundary clips cells, and
/// of one without a boundary.
Mesh inner_mesh(Mesh&& mesh, Boundary boundary);

} // namespace calotte::cvt_detail
