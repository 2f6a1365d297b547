// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/room.h"

#include <calotte/mesh.h>

/// Builds a mesh from the contents of a file.
namespace calotte::mesh_detail {

/// The triangle across from each vertex, in linear time, in parallel. It is -1 along an open edge,
/// along an edge of three triangles, and along an edge that two triangles run through in the same
/// direction. \pre ids are in [0, points).
Triangles neighbours_of(const Triangles& triangles, std::int64_t points);

/// A mesh whose triangles refer to input columns. A column in no triangle is a duplicate of an
/// equal column in a triangle, if there is one: of the same direction, or in a plane of the same
/// coordinates. The other columns are sites. \pre as neighbours_of.
Mesh mesh_of_columns(const Points3& columns, const Triangles& triangles,
                     const Surface& surface = {});

} // namespace calotte::mesh_detail
