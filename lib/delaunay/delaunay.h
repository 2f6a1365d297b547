// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "delaunay/regions.h"
#include "delaunay/room.h"
#include "delaunay/sites.h"

#include <calotte/delaunay.h>

/// All stages from a caller's points to a mesh, one function a surface.
namespace calotte::delaunay_detail {

/// \throws Error as triangulate(), as do the functions below.
Mesh mesh_of_sphere(const Points3Ref& points, const DelaunayOptions& options,
                    DelaunayReport& report);

/// The same for points that the mesh may take over. It does so unless some of them merge.
Mesh mesh_of_sphere(Points3&& points, const DelaunayOptions& options, DelaunayReport& report);

/// The mesh of points in the plane, with z = 0.
Mesh mesh_of_plane(const Points2Ref& points, const DelaunayOptions& options,
                   DelaunayReport& report);

/// The mesh of points in a doubly periodic box. \pre the surface is one.
Mesh mesh_of_box(const Points2Ref& points, const Surface& box, const DelaunayOptions& options,
                 DelaunayReport& report);

/// The stages after divide(), on the sphere: the Delaunay triangulation of sites for a caller that
/// already has their regions.
/// \throws Error degenerate for sites on one great circle.
Mesh spherical_mesh(Sites&& sites, Regions&& regions);

} // namespace calotte::delaunay_detail
