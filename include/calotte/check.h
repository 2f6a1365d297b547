// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/progress.h>
#include <calotte/types.h>

#include <string>

CALOTTE_API_BEGIN
namespace calotte {

/// The result of `check`. `failure` is one line that describes the first violated law and names the
/// triangle, edge or site; it is empty if all laws hold.
struct Check {
  std::string failure;
  std::int64_t sites = 0;
  std::int64_t triangles = 0;
  std::int64_t boundary_edges = 0;
  double area = 0; ///< sum of the triangles' areas: steradians on the unit sphere, or of the plane
  /// Expected area: 4 pi (0 for an open mesh); in the plane that of the hull or box.
  double whole = 0;

  bool passed() const { return failure.empty(); }
};

/// Proves that a mesh is the Delaunay triangulation of its points. It checks that
/// - ids are in range, triangles are in canonical order, and neighbours are mutual;
/// - each edge belongs to two triangles, or to one along an open boundary;
/// - every site is a vertex with a single cycle of triangles, on the boundary with a single fan;
/// - Euler's characteristic is 2, or 1 for an open mesh;
/// - every triangle is counter-clockwise;
/// - every edge is Delaunay in exact arithmetic, with the library's tie-breaking rule;
/// - the boundary is convex, and the areas of a closed mesh sum to 4 pi. These local properties
///   imply the global one (Delaunay, 1934), so the time is linear.
///
/// \param progress if set, called between blocks of triangles, with the stage "check". A mesh that
///         is open or broken is read more than once: the fraction then stands still.
/// \throws Error cancelled.
Check check(const Mesh& mesh, const ProgressCallback& progress = {});

/// The same in the plane: Euler's characteristic 1, and areas that sum to that of the boundary's
/// polygon; in a periodic box no boundary, Euler's characteristic 0, and areas that sum to the
/// box's. There a triangle wider than half of the box counts as a failure, as periodic_delaunay()
/// makes none.
Check check(const PlanarMesh& mesh, const ProgressCallback& progress = {});

} // namespace calotte
CALOTTE_API_END
