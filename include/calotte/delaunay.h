// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/options.h>
#include <calotte/types.h>

#include <concepts>
#include <cstdint>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// Times and counts of one run. Seconds are wall-clock time.
struct DelaunayReport {
  /// Times of the stages.
  struct Seconds {
    double sites = 0;          ///< check, normalise, curve order, duplicates
    double regions = 0;        ///< centres, owners, halos
    double triangulate = 0;    ///< gather, project, triangulate, cull and certify: all regions
    double unite = 0;          ///< the seams' union, canonical order, adjacency
    double total = 0;          ///< all of the call, from the caller's points to the mesh
  } seconds;                   ///< of the stages
  std::int64_t sites = 0;      ///< distinct sites of the input
  std::int64_t duplicates = 0; ///< input columns that were merged into another
  int regions = 0;             ///< their number
  int threads = 0;             ///< of the task arena it ran in
  bool one_region = false;     ///< the sites were triangulated serially as one region
  double overlap = 0; ///< sites of all regions, halos included, divided by the number of sites
  std::vector<std::int64_t> sites_per_region; ///< owned and halo
  std::vector<std::int64_t> owned_per_region; ///< owned alone
  std::vector<double> seconds_per_region;     ///< gather to certify, by region
  /// Reports of triangles whose circumcap lies in the covered part.
  std::int64_t certified_by_cull = 0;
  std::int64_t certified_by_query = 0;  ///< reports certified by a query of their circumcap
  std::int64_t halo_insertions = 0;     ///< sites that such queries added to regions
  std::int64_t seam_triangles = 0;      ///< triangles whose vertices have different owners
  std::int64_t filtered_predicates = 0; ///< predicates that the first tier passed to the second
  std::int64_t exact_predicates = 0;    ///< predicates that needed exact arithmetic
};

/// The Delaunay triangulation of the directions of `points` on the unit sphere.
///
/// The result depends only on the set of directions: it has the same bits for any number of threads
/// and regions, any `sort` and any centres; a permuted input permutes the ids. One symbolic rule
/// resolves cocircular sites (design of the in-circle predicate in lib/exact/predicates.h). It runs
/// in the caller's task arena.
///
/// \param points 3 x n directions of any norm from 1e-200 to 1e200, n from 3 to 2^30.
/// \param report if not null, receives times and counts; default null.
/// \throws Error bad_option (not 3 rows, more than 2^30 points, or an option out of range; see
///         DelaunayOptions and Partition), not_finite, zero_vector, duplicate (when refused),
///         too_few_sites (fewer than 3 distinct), degenerate (all on one great circle), cancelled
///         (by options.progress).
///
/// Jacobsen, Gunzburger, Ringler, Burkardt, Peterson: Parallel algorithms for planar and spherical
/// Delaunay construction, Geosci. Model Dev. 6, 1353-1365, 2013.
Mesh spherical_delaunay(const PointsRef& points, const DelaunayOptions& options = {},
                        DelaunayReport* report = nullptr);

/// The same for points handed over: an rvalue Points3. The mesh takes them over without a copy,
/// unless some of them merge.
template <std::same_as<Points3> Points>
Mesh spherical_delaunay(Points&& points, const DelaunayOptions& options = {},
                        DelaunayReport* report = nullptr);
/// Its one specialisation.
template <>
CALOTTE_API_SPECIALISATION Mesh spherical_delaunay(Points3&& points, const DelaunayOptions& options,
                                                   DelaunayReport* report);

/// The Delaunay triangulation of the convex hull of places in the plane, counter-clockwise.
/// Coordinates of any size are exact as stored. The result is unique as that of
/// spherical_delaunay().
///
/// \param points 2 x n places in any unit of length, n from 3 to 2^30.
/// \param options merge_within is a distance in that unit.
/// \param report if not null, receives times and counts; default null.
/// \throws Error bad_option (not 2 rows, more than 2^30 points, or an option out of range),
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
/// \throws Error as planar_delaunay(); bad_option for a period out of range or a point outside the
///         box; too_few_sites if a circle wider than half of the box holds no site.
PlanarMesh periodic_delaunay(const PointsRef& points, const Eigen::Vector2d& period,
                             const DelaunayOptions& options = {}, DelaunayReport* report = nullptr);

} // namespace calotte
CALOTTE_API_END
