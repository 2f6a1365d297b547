// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/delaunay.h"
#include "io/cells/raw_mesh.h"
#include "io/cells/room.h"

#include <calotte/mesh_file.h>

#include <string>

/// The only code that makes a mesh of the contents of a file. The mesh is in canonical form: ids in
/// range; triangles counter-clockwise, from their lowest vertex on, and sorted; at most two
/// triangles at each edge.
namespace calotte::io_detail {

/// A mesh of triangles, cells or both, on the surface of the raw mesh. In a plane z is 0 at all
/// points.
/// \param format for messages.
/// \throws Error parse, for a file that contradicts itself; invalid_argument, for a mesh of the
/// plane where one of the sphere is required, and the reverse; what delaunay() throws, with the
/// name of the file.
MeshFile make_mesh_file(const std::string& name, const std::string& format, RawMesh raw);

/// A mesh whose triangles refer to columns of points of the caller. It is planar if z is 0 at all
/// of them.
/// \throws Error parse.
MeshFile make_mesh_file_on_points(const std::string& name, const Points3& points,
                                  Triangles triangles);

/// Whether there are at least three points and z is 0 at all of them, as in a mesh of the plane.
bool lies_in_plane(const Points3& points);

/// \throws Error parse, for a point without a direction.
void require_directions(const std::string& name, const Points3& points);

/// Requires directions, or points with z = 0. Readers have moved points of a periodic plane into
/// it.
/// \throws Error parse; invalid_argument, for points or cells of another surface than the mesh's.
void require_points(const std::string& name, RawMesh& raw);

/// The radius of the sphere of all points, to 12 digits; 1 if they are not on a sphere, up to the
/// rounding in files.
double find_radius(const Points3& points);

} // namespace calotte::io_detail
