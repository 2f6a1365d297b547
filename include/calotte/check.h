// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/progress.h>

#include <array>
#include <cstdint>
#include <string>

CALOTTE_API_BEGIN
namespace calotte {

/// The result of `check`.
struct CheckReport {
  /// One line that describes the first violated law and names the triangle, edge or site; empty if
  /// all laws hold.
  std::string failure;
  std::int64_t sites = 0;          ///< number of points
  std::int64_t triangles = 0;      ///< number of triangles
  std::int64_t boundary_edges = 0; ///< number of edges of one triangle
  /// Sum of the areas of the triangles: steradians on the unit sphere; in the plane the square of
  /// the points' unit. 0 if an earlier law is violated.
  double area = 0;
  /// Expected area: 4 pi (0 for an open mesh); in the plane that of the boundary polygon, the box
  /// or the channel.
  double expected_area = 0;

  /// True if all laws hold.
  bool passed() const { return failure.empty(); }
};

/// Proves that a mesh is the Delaunay triangulation of its points on its surface, whose rings do
/// not count. It checks that
/// - in the plane z = 0, and in a periodic direction every site is in [0, period);
/// - ids are in range, triangles are in canonical order, and neighbours are mutual;
/// - each edge belongs to two triangles, or to one along an open boundary;
/// - every site is a vertex with a single cycle of triangles, on the boundary with a single fan;
/// - Euler's characteristic is 2 for a closed mesh of the sphere, 1 for an open one and in the
///   plane, and 0 with a period;
/// - every triangle is counter-clockwise;
/// - every edge is Delaunay in exact arithmetic, with the library's tie-breaking rule;
/// - the boundary is convex, in a channel straight;
/// - the areas of a closed mesh of the sphere sum to 4 pi, in the plane to that of the boundary
///   polygon, in a box to that of the box, in a channel to the period times the distance of the
///   walls;
/// - with a period no triangle is wider than half of it: triangulate() makes none.
///
/// These local properties imply the global one (Delaunay, 1934), so the time is linear.
///
/// A mesh that violates a law is a result, not an error.
///
/// \param progress if set, called between blocks of triangles, with the stage "check". A mesh that
///         is open or broken is read more than once; the fraction may then stay constant.
/// \throws Error cancelled.
CheckReport check(const Mesh& mesh, const ProgressCallback& progress = {});

/// Proves less, for a mesh that need be neither Delaunay nor convex, such as a region cut from a
/// larger mesh, or an ocean: ids, canonical order and neighbours as above; every triangle
/// counter-clockwise; the triangles at each site a single cycle that turns around it once, a single
/// fan, or several fans where the boundary passes more than once; and the areas of a closed mesh of
/// the sphere sum to 4 pi, in the plane to that of the boundary polygons or of the closed box.
/// Sites in no triangle are allowed. Such triangles do not overlap near any edge, nor near a site
/// of one cycle or fan.
/// \throws Error cancelled.
CheckReport check_surface(const Mesh& mesh, const ProgressCallback& progress = {});

/// Counts of what keeps a mesh from being the Delaunay triangulation of its points, or closed.
struct EdgeCounts {
  std::int64_t edges = 0;    ///< of all triangles
  std::int64_t boundary = 0; ///< edges of one triangle
  std::int64_t loops = 0;    ///< closed lines of boundary edges; 0 for a closed mesh
  /// Boundary sites at which the boundary turns towards the outside by more than a straight line:
  /// the mesh does not fill its hull there.
  std::int64_t not_convex = 0;
  /// Edges whose opposite site lies inside the circumcap or circumcircle, by more than rounding:
  /// their Voronoi edge has a length below -1e-9 of their own. The mesh has no Voronoi cells there.
  std::int64_t not_delaunay = 0;
  /// Edges between sites that are cocircular up to that rounding, and that follow another diagonal
  /// than the library's rule. They make the same Voronoi cells.
  std::int64_t cocircular = 0;
  std::int64_t unused_sites = 0; ///< sites in no triangle
  std::array<std::int32_t, 2> first = {-1,
                                       -1}; ///< the sites of the first edge that is not Delaunay
  double shortest = 0; ///< the least length of a Voronoi edge over that of its edge; 0 or negative
};

/// Counts edges of a mesh that need not be Delaunay or convex. Linear time; the signs are exact.
/// \pre ids are in range, triangles are counter-clockwise, neighbours are mutual, as read_mesh()
/// makes them.
EdgeCounts count_edges(const Mesh& mesh);

} // namespace calotte
CALOTTE_API_END
