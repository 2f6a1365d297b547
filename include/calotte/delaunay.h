// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/progress.h>

#include <concepts>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// The sites that a region triangulates besides its own. The choice affects time and memory, not
/// the result.
enum class RegionOverlap {
  halo,     ///< those within a thin strip around its coarse Voronoi cell; the default
  distance, ///< those closer to its centre than the farthest neighbouring centre (Jacobsen et al.,
            ///< 2013, Sect. 2.1.1)
  voronoi,  ///< those owned by the neighbouring regions (same section)
};

/// How the centres of the regions are chosen.
enum class RegionCentres {
  /// A coarse CVT of a sample of the sites, so that regions have about equal work; the default.
  sample,
  /// A Fibonacci lattice on the sphere, or in the plane over the bounding box of the sites. It
  /// ignores the density of the sites.
  fibonacci,
};

/// The division of the sites into regions, which are triangulated in parallel. These options affect
/// time and memory, not the result.
///
/// A function that takes them throws Error invalid_argument for an option out of range; for a
/// centre that is out of range, index() is its column.
struct Decomposition {
  /// Number of regions; >= 1. The library uses at most one per site. Default: 1 for fewer than 4096
  /// sites, otherwise one per 16384 sites, but at least 12.
  std::optional<int> regions = {};
  RegionCentres centres = RegionCentres::sample; ///< no effect if given_centres is set
  /// The centres of the regions, at least one column; overrides the two options above. On the
  /// sphere 3 x k finite, non-zero directions of any norm. In the plane 2 x k finite points in the
  /// unit of the points, or 3 x k, whose third row is ignored. Default: none.
  std::optional<DoubleMatrix> given_centres = {};
  RegionOverlap overlap = RegionOverlap::halo; ///< no effect if there is one region
};

/// The treatment of points of equal direction, in the plane of equal position, and of points that
/// merge_within joins.
enum class Duplicates {
  merge,  ///< they become one site, that of the lowest index; the default
  refuse, ///< the function throws Error duplicate; index() is the first that duplicates another
};

/// Options of a triangulation. `duplicates` and `merge_within` affect the result.
struct DelaunayOptions {
  Duplicates duplicates = Duplicates::merge; ///< see Duplicates
  /// A site nearer than this to an earlier site that stays is merged into it; >= 0 and finite.
  /// Default 0: only equal sites merge. On the sphere an angle in radians, measured in doubles to
  /// 1e-15. In the plane a distance in the unit of the points, not measured across the edge of a
  /// periodic box.
  double merge_within = 0;
  Decomposition decomposition = {}; ///< affects time and memory, not the result
  /// Stages: sites, regions, triangulate, unite; in a periodic box it may repeat the last three.
  /// Default: none.
  ProgressCallback progress = {};
};

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
  bool serial = false;         ///< the sites were triangulated serially as one region
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

/// A matrix, a map, a block or an expression of Eigen.
template <class T>
concept EigenMatrix = std::derived_from<T, Eigen::MatrixBase<T>>;

/// A Delaunay triangulation, and how it was made.
struct Triangulation {
  Mesh mesh;             ///< its surface is the given one
  DelaunayReport report; ///< times and counts
};

/// The Delaunay triangulation of points of a surface, counter-clockwise, on the sphere seen from
/// outside.
///
/// - On the sphere a point is a direction, of any norm from 1e-200 to 1e200. The triangulation
///   covers the sphere, or, if all points lie in a hemisphere, their spherical convex hull.
/// - In the plane it covers the convex hull. Coordinates of any size are exact as stored.
/// - In a plane with two periods it has 2n triangles and no boundary; the points lie in [0,
///   period), and their copies are at the exact sums of coordinates and periods. All counts of the
///   report but `sites` and `duplicates` include the copies around the box.
///
/// Rings of the surface do not change the triangulation. The mesh keeps them, and they clip the
/// cells of voronoi().
///
/// The result depends only on the set of points: it has the same bits for any number of threads and
/// regions, any overlap and any centres; a permuted input permutes the ids. One symbolic rule
/// resolves cocircular points (lib/exact/predicates.h). The function runs in the caller's task
/// arena.
///
/// Jacobsen, Gunzburger, Ringler, Burkardt, Peterson: Parallel algorithms for planar and spherical
/// Delaunay construction, Geosci. Model Dev. 6, 1353-1365, 2013.
///
/// \param points n columns, n from 3 to 2^30: 3 rows on the sphere; in the plane 2, or 3 of which z
///        is 0; in any unit of length.
/// \param surface where the points live. Default: the sphere.
/// \param options merge_within is an angle in radians on the sphere, in the plane a distance.
/// \throws Error invalid_argument: another number of rows, more than 2^30 points, an option out of
///         range (see DelaunayOptions and Decomposition); with its index a point that has a z in
///         the plane or is outside the box; a plane with one period, whose meshes come from
///         make_grid() or a file. Also not_finite, zero_vector (on the sphere), duplicate (when
///         refused); too_few_sites, for fewer than 3 distinct points, and if a circle wider than
///         half of the box contains none; degenerate, for points on one great circle or line;
///         cancelled by options.progress.
Triangulation triangulate(const PointsRef& points, const Surface& surface = {},
                          const DelaunayOptions& options = {});

/// The same for points that the function may move, as in triangulate(std::move(points)): on the
/// sphere the mesh takes them without a copy, unless some of them merge.
Triangulation triangulate(Points3&& points, const Surface& surface = {},
                          const DelaunayOptions& options = {});

/// The same for other types of Eigen: without this overload, most would convert to both PointsRef
/// and Points3.
template <EigenMatrix Points>
Triangulation triangulate(const Points& points, const Surface& surface = {},
                          const DelaunayOptions& options = {}) {
  return triangulate(PointsRef(points), surface, options);
}

/// The mesh of triangulate() alone; parameters and errors as there.
inline Mesh delaunay(const PointsRef& points, const Surface& surface = {},
                     const DelaunayOptions& options = {}) {
  return triangulate(points, surface, options).mesh;
}

/// The same for points that the function may move.
inline Mesh delaunay(Points3&& points, const Surface& surface = {},
                     const DelaunayOptions& options = {}) {
  return triangulate(std::move(points), surface, options).mesh;
}

/// The same for other types of Eigen.
template <EigenMatrix Points>
Mesh delaunay(const Points& points, const Surface& surface = {},
              const DelaunayOptions& options = {}) {
  return triangulate(PointsRef(points), surface, options).mesh;
}

} // namespace calotte
CALOTTE_API_END
