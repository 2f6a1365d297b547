// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

#include <calotte/mesh.h>
#include <calotte/voronoi.h>

#include <cstdint>

/// The far side of a mesh whose sites lie in a hemisphere.
namespace calotte::voronoi_detail {

/// The convex hull of the sites' directions as points of the unit sphere: the triangles of an open
/// mesh and, across its boundary, those of the far side, in canonical order. 2n - 4 triangles.
///
/// A triangle of the far side has a circumcap larger than a hemisphere, which contains no site. Its
/// vertices are on the boundary and run clockwise seen from outside the sphere, thus
/// counter-clockwise seen from outside the hull. The triangulation of the boundary is found by
/// flips, each decided exactly; on a boundary of k sites they take O(k^2) time at worst.
/// \param mesh open.
/// \throws Error invalid_argument, naming a site, for a mesh whose boundary is not that of the
///         sites' hull: it has several parts, a corner to the inside, or sites without triangles;
///         for one that fails check_surface().
Mesh triangulate_hull(const Mesh& mesh);

/// Sets the kites of a triangle on the far side, and its area.
///
/// The point opposite its circumcentre lies, from the middle of its edge ab, a signed arc delta
/// towards its third vertex, see geometry.h; the circumcentre an arc pi - delta away from it. With
/// theta the arc ab, a half kite at the boundary has the area 2 atan(tan(theta/4) cot(delta/2)),
/// from the middle of ab. A half kite between two triangles of the far side has that area minus pi;
/// it starts at the point opposite the middle, near which the Voronoi edge passes. No difference of
/// large terms occurs where circumcentres are nearly opposite their sites.
void measure_far(const Mesh& hull, std::int64_t triangle, Voronoi& out);

/// True for a triangle of triangulate_hull() on the far side, whose circumcentre is there.
bool is_far(const Mesh& hull, std::int64_t triangle);

} // namespace calotte::voronoi_detail
