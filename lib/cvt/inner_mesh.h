// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"

#include <calotte/cvt.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cstdint>
#include <span>

/// The triangles of a mesh that belong to a bounded surface.
namespace calotte::cvt_detail {

/// The mesh of the triangles between generators only. In a mesh with a hull, generators come first.
Mesh without_hull(Points3&& generators, const Triangles& triangles, const Surface& surface);

/// The mesh of generators that ends at those on the boundary: each outer edge joins two that follow
/// each other on a ring, and the others are Delaunay as far as these allow. On a surface with land
/// or sea narrower than a cell not all of these edges may exist. The mesh is then made of the
/// triangles that has_centre() allows.
/// \param next of the first generators the next one along the boundary, see Schedule.
Mesh mesh_to_boundary(Points3&& points, const Surface& surface, std::span<const std::int32_t> next);

/// The part of a mesh whose cells the boundary clips, see Boundary::clip. Triangles that touch the
/// others at a site only in a vertex are removed. A mesh in a plane, and one without a boundary, is
/// returned whole.
Mesh inner_mesh(Mesh&& mesh);

} // namespace calotte::cvt_detail
