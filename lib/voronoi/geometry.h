// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/vec3.h"
#include "voronoi/dual_measures.h"
#include "voronoi/room.h"

#include <calotte/voronoi.h>

#include <array>
#include <cstdint>

namespace calotte::voronoi_detail {

/// Sets all positions, lengths, angles and areas of a tessellation from its cells and ids.
///
/// A triangle's circumcentre lies, from the middle of its edge ab, a signed arc delta away, towards
/// the third vertex c: tan(delta) = |a-b| cos(C)|a-c||b-c| / (2 h), h the height of the centre's
/// parallelepiped a . (b-a) x (c-a); in the plane delta = |a-b| cot(C)/2. All three edges share the
/// height, so that its rounding moves the centre, but leaves the sum of the kites. Half a kite,
/// with theta the arc ab, has the signed area 2 atan(tan(theta/4) tan(delta/2)); in the plane |a-b|
/// delta/4. A Voronoi edge is as long as the sum of both its deltas, which keeps more digits than
/// the distance of two close circumcentres.
///
/// The deltas of three sites that are equal up to rounding are 0.
void measure(Voronoi& out);

/// measure() in parts, for callers that use positions and angles as they are computed and store
/// neither. The order is begin_measures(), all vertices, all edges; measure_areas() may follow the
/// vertices. Several threads may measure disjoint ranges.

/// The argument `surplus` of the functions below: by cell its norm minus 1, to a few digits; empty
/// in a plane.
Array<double> surplus_of(const Surface& surface, const Points3& cells);

/// Makes room for kites, dv and dc. \returns surplus_of() the cells.
Array<double> begin_measures(Voronoi& out);

/// Sets the kites of vertices begin to end - 1.
/// \param positions receives the vertices.
void measure_vertices(const Array<double>& surplus, std::int64_t begin, std::int64_t end,
                      Voronoi& out, Vec3* positions);

/// Sets dv and dc of edges begin to end - 1.
/// \param positions receives the midpoints. \param angles receives the angles of the normals.
void measure_edges(const Array<double>& surplus, std::int64_t begin, std::int64_t end, Voronoi& out,
                   Vec3* positions, double* angles);

/// Sets the areas of the cells.
void measure_areas(Voronoi& out);

/// The half kites of a triangle, by the vertex across from their side.
using HalfKites = std::array<dual::HalfKite, 3>;

/// Sets the half kites of triangles begin to end - 1, in a plane without periods, too; for callers
/// that need no more of a tessellation.
void measure_half_kites(const Surface& surface, const Points3& cells, const Array<double>& surplus,
                        const Triangles& triangles, std::int64_t begin, std::int64_t end,
                        HalfKites* out);

/// The area of a triangle of a closed mesh, as Voronoi::vertex_area stores it.
inline double vertex_area(const Voronoi& of, std::int64_t vertex) {
  double sum = 0;
  for (int j = 0; j < 3; ++j)
    sum += of.kites(j, vertex);
  return sum;
}

} // namespace calotte::voronoi_detail
