// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/progress.h>
#include <calotte/types.h>

#include <string>

CALOTTE_API_BEGIN
namespace calotte {

/// What `check` found. `failure` is one line on the first law that does not hold, naming the
/// triangle, edge or site; empty when all hold.
struct Check {
  std::string failure;
  std::int64_t sites = 0;
  std::int64_t triangles = 0;
  std::int64_t boundary_edges = 0;
  double area = 0;  ///< sum of the triangles' areas: steradians on the unit sphere, or of the plane
  double whole = 0; ///< what it should be: 4 pi (0 for an open mesh); of the plane's hull or box

  bool passed() const { return failure.empty(); }
};

/// Proves that a mesh is the Delaunay triangulation of its own points: ids in range; canonical
/// order; neighbours mutual; each edge in two triangles, or in one along an open boundary; every
/// site a vertex with a single cycle (or, on the boundary, a single fan) of triangles; Euler's
/// characteristic; every triangle counter-clockwise; every edge Delaunay in exact arithmetic, ties
/// by the library's rule; a boundary that is convex; areas that sum to 4 pi when closed. Local
/// properties imply the global one (Delaunay, 1934), so the cost is linear.
///
/// \param progress if set, called between blocks of triangles, with the stage "check". A mesh that
///        is open or broken is read more than once: the fraction then stands still.
/// \throws Error cancelled.
Check check(const Mesh& mesh, const ProgressCallback& progress = {});

/// The same in the plane: Euler's characteristic 1, and areas that sum to that of the boundary's
/// polygon; in a periodic box no boundary, Euler's characteristic 0, and areas that sum to the
/// box's. There a triangle wider than half of the box counts as a failure, as periodic_delaunay()
/// makes none.
Check check(const PlanarMesh& mesh, const ProgressCallback& progress = {});

} // namespace calotte
CALOTTE_API_END
