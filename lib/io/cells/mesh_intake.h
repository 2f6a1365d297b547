// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/delaunay.h"
#include "io/cells/raw_mesh.h"
#include "io/cells/room.h"

#include <calotte/mesh_file.h>

#include <string>

/// The one place where what a file holds becomes a mesh in canonical form: ids in range, triangles
/// counter-clockwise, from their lowest vertex on and sorted, each edge of two triangles at most.
namespace calotte::io_detail {

/// A mesh of triangles, cells or both, on the surface that the raw mesh says. In a plane z is 0 at
/// all points. \param format for messages.
/// \throws Error parse, for a file that contradicts itself; invalid_argument, for a mesh of the
/// plane that shall be one of the sphere, and the reverse; what delaunay() throws, with the file's
/// name.
MeshFile mesh_file_of(const std::string& name, const std::string& format, RawMesh raw);

/// A mesh whose triangles refer to columns of points that a caller has, of the plane if z is 0 at
/// all of them. \throws Error parse.
MeshFile mesh_file_of_columns(const std::string& name, const Points3& points, Triangles triangles);

/// Whether z is 0 at all of three or more points: a mesh of the plane.
bool lies_in_plane(const Points3& points);

/// \throws Error parse, for a point without a direction.
void require_directions(const std::string& name, const Points3& points);
/// \throws Error invalid_argument, for points of the plane.
void require_sphere(const std::string& name, const Points3& points);

/// Of the sphere that all points stand on but for their digits, with 12 of its own; 1 where there
/// is none.
double radius_of(const Points3& points);

} // namespace calotte::io_detail
