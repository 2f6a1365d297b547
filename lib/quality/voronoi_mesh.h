// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/require.h"
#include "quality/room.h"

#include <calotte/check.h>

namespace calotte::quality_detail {

/// Requires a valid surface. \returns the report of check_surface(), which has passed.
/// \throws Error invalid_argument.
inline CheckReport require_surface(const Mesh& mesh) {
  CheckReport found = check_surface(mesh);
  require(found.passed(), "the triangles do not form a surface: {}; triangulate the points anew",
          found.failure);
  return found;
}

/// Requires a mesh that is the Delaunay triangulation of its points. Other diagonals between
/// cocircular sites are allowed: they give the same cells.
/// \param mesh of the sphere or the plane.
/// \returns the report of check() or, with such diagonals, of check_surface().
/// \throws Error invalid_argument.
inline CheckReport require_voronoi_mesh(const Mesh& mesh) {
  CheckReport found = check(mesh);
  if (found.passed())
    return found;
  const std::string failure = found.failure;
  found = check_surface(mesh);
  const EdgeCounts edges = found.passed() ? count_edges(mesh) : EdgeCounts{};
  require(edges.cocircular > 0 && edges.not_delaunay == 0 && edges.not_convex == 0 &&
              edges.unused_sites == 0,
          "the mesh is not the Delaunay triangulation of its points, so it has no Voronoi "
          "cells: {}; triangulate the points anew",
          failure);
  return found;
}

} // namespace calotte::quality_detail
