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

/// A mesh of the sphere, of triangles, cells or both. \param format for messages.
/// \throws Error parse, for a file that contradicts itself; invalid_argument, for a mesh of the
/// plane; what delaunay() throws, with the file's name.
MeshFile mesh_file_of(const std::string& name, const std::string& format, RawMesh raw);

/// A mesh of the plane, with z = 0 at all points. \throws Error as above; invalid_argument, where z
/// is not 0.
MeshFile planar_mesh_file_of(const std::string& name, const std::string& format, RawMesh raw);

/// A mesh whose triangles refer to columns of points that a caller has, of the plane if z is 0 at
/// all of them. \throws Error parse.
MeshFile mesh_file_of_columns(const std::string& name, const Points3& points, Triangles triangles);

/// A mesh in a periodic plane, whose points are within the periods. It has a boundary where `rest`
/// has polygons, one for each point. \throws Error parse.
MeshFile periodic_mesh_file_of(const std::string& name, Mesh mesh, RawMesh rest);

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
