// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/room.h"

#include <calotte/mesh.h>

/// Builds a mesh from the contents of a file.
namespace calotte::mesh_detail {

/// The triangle across from each vertex, in linear time, in parallel. -1 along an open edge, and
/// along one of three triangles, or of two that run through it the same way. \pre ids are in [0,
/// points).
Triangles neighbours_of(const Triangles& triangles, std::int64_t points);

/// A mesh whose triangles refer to input columns: a column in no triangle that has the same
/// direction as one in a triangle, or the same coordinates in a plane, is its duplicate; the others
/// stay as sites. \pre as neighbours_of.
Mesh mesh_of_columns(const Points3& columns, const Triangles& triangles,
                     const Surface& surface = {});

} // namespace calotte::mesh_detail
