// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "delaunay/regions.h"
#include "delaunay/room.h"
#include "delaunay/sites.h"
#include "mesh/planar_mesh.h"

#include <calotte/delaunay.h>

/// All stages from a caller's points to a mesh, one function a surface.
namespace calotte::delaunay_detail {

/// \throws Error as triangulate(), as do the functions below.
Mesh mesh_of_sphere(const Points3Ref& points, const DelaunayOptions& options,
                    DelaunayReport& report);

/// The same for points handed over: the mesh takes them, unless some of them merge.
Mesh mesh_of_sphere(Points3&& points, const DelaunayOptions& options, DelaunayReport& report);

/// In the plane, with z = 0.
Mesh mesh_of_plane(const Points2Ref& points, const DelaunayOptions& options,
                   DelaunayReport& report);

/// In a doubly periodic box.
PlanarMesh mesh_of_box(const Points2Ref& points, const Eigen::Vector2d& period,
                       const DelaunayOptions& options, DelaunayReport& report);

/// The stages after divide(), on the sphere: the Delaunay triangulation of sites for a caller that
/// already has their regions.
/// \throws Error degenerate for sites on one great circle.
Mesh spherical_mesh(Sites&& sites, Regions&& regions);

} // namespace calotte::delaunay_detail

// ---- The same with a report, one function a surface, for the rooms above.

namespace calotte {

/// The Delaunay triangulation of the directions of `points` on the unit sphere.
///
/// The result depends only on the set of directions: it has the same bits for any number of threads
/// and regions, any `overlap` and any centres; a permuted input permutes the ids. One symbolic rule
/// resolves cocircular sites (design of the in-circle predicate in lib/exact/predicates.h). It runs
/// in the caller's task arena.
///
/// \param points 3 x n directions of any norm from 1e-200 to 1e200, n from 3 to 2^30.
/// \param report if not null, receives times and counts; default null.
/// \throws Error invalid_argument (not 3 rows, more than 2^30 points, or an option out of range;
///         see DelaunayOptions and Partition), not_finite, zero_vector, duplicate (when refused),
///         too_few_sites (fewer than 3 distinct), degenerate (all on one great circle), cancelled
///         (by options.progress).
///
/// Jacobsen, Gunzburger, Ringler, Burkardt, Peterson: Parallel algorithms for planar and spherical
/// Delaunay construction, Geosci. Model Dev. 6, 1353-1365, 2013.
Mesh spherical_delaunay(const PointsRef& points, const DelaunayOptions& options = {},
                        DelaunayReport* report = nullptr);

/// As above, for points handed over: an rvalue Points3. The mesh takes them over without a copy,
/// unless some of them merge.
template <std::same_as<Points3> Points>
Mesh spherical_delaunay(Points&& points, const DelaunayOptions& options = {},
                        DelaunayReport* report = nullptr);
/// Its one specialisation.
template <>
Mesh spherical_delaunay(Points3&& points, const DelaunayOptions& options, DelaunayReport* report);

/// The Delaunay triangulation of the convex hull of places in the plane, counter-clockwise.
/// Coordinates of any size are exact as stored. The result is unique as that of
/// spherical_delaunay().
///
/// \param points 2 x n places in any unit of length, n from 3 to 2^30.
/// \param options merge_within is a distance in that unit.
/// \param report if not null, receives times and counts; default null.
/// \throws Error invalid_argument (not 2 rows, more than 2^30 points, or an option out of range),
///         not_finite, duplicate (when refused), too_few_sites (fewer than 3 distinct), degenerate
///         (all on one line), cancelled (by options.progress).
PlanarMesh planar_delaunay(const PointsRef& points, const DelaunayOptions& options = {},
                           DelaunayReport* report = nullptr);

/// The Delaunay triangulation of the doubly periodic box [0, period.x) x [0, period.y): 2n
/// triangles, no boundary. It is exact for copies at the exact sums of coordinates and periods. All
/// counts of the report but `sites` and `duplicates` include the copies around the box.
///
/// \param points 2 x n places inside the box.
/// \param period side lengths of the box, positive, at most 1e300, in the unit of the points.
/// \throws Error as planar_delaunay(); invalid_argument for a period out of range or a point
///         outside the box; too_few_sites if a circle wider than half of the box holds no site.
PlanarMesh periodic_delaunay(const PointsRef& points, const Eigen::Vector2d& period,
                             const DelaunayOptions& options = {}, DelaunayReport* report = nullptr);

} // namespace calotte
