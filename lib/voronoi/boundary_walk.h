// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "domain/surface.h"
#include "voronoi/room.h"

#include <calotte/matrices.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

/// The cells along the boundary of a part of a plane or of the sphere.
namespace calotte::voronoi_detail {

/// The neighbours of each site in a Delaunay triangulation.
using Neighbours = Lists<std::vector<std::int32_t>, std::vector<std::int64_t>>;

/// A point on the boundary where sides of cells along it meet: a corner of the boundary, or the end
/// of a Voronoi edge.
struct BoundaryVertex {
  Vec3 point; ///< on the sphere a unit vector
  /// The cells of the sides that end and start here, with the domain to the left; equal at a corner
  /// of the boundary within a cell. Others are neighbours.
  std::int32_t before, after;

  bool crossing() const { return before != after; }
};

/// The vertices of each ring of the boundary, with the domain to the left.
///
/// Along an edge of the boundary, on the sphere along the chord of the arc, the squared distances
/// of sites differ by linear functions, whose lower envelope is the sequence of cells: from each
/// cell the walk continues to the neighbour whose bisector comes first. Each step makes progress in
/// the edge's direction, so that the walk ends, and the vertices of a ring form a closed walk in
/// the triangulation, whatever the rounding. A bisector that runs along the boundary up to rounding
/// belongs to the site on the domain's side.
///
/// \param sites unit columns; in the plane with z = 0.
template <Space S>
std::vector<std::vector<BoundaryVertex>>
walk_boundary(const OutlineOf<S>& outline, const Points3& sites, const Neighbours& neighbours);

} // namespace calotte::voronoi_detail
