// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/types.h>

#include <cstdint>

CALOTTE_API_BEGIN
namespace calotte {

/// Where positions lie in a mesh; one element, or column, for each position.
struct Locations {
  /// The triangle that holds the position, of several that hold it the lowest: triangles include
  /// their edges and vertices. -1 outside of an open mesh. Exact.
  Ids triangle;
  /// 3 x n, barycentric: the position, or on the sphere its direction, is the sum of the triangle's
  /// vertices, unit vectors on the sphere, times the weights, up to a factor. From 0 to 1, their
  /// sum is 1; exactly 0 on the edge across. NaN outside.
  Triples weights;
  /// The nearest site, the lowest of those that are equally near. Exact in a Delaunay triangulation
  /// and in a part of one, also where sites have no triangle.
  Ids nearest;
};

/// Locates positions in a triangulation. With a period the positions may lie outside of the box:
/// their copies inside are located.
///
/// The positions are sorted along a space-filling curve; from the triangle of each, a walk leads to
/// that of the next across edges that separate them (Lawson, in: Mathematical Software III, 1977),
/// in parallel.
/// \param mesh a Delaunay triangulation, or a part of one. In a mesh that is none, the nearest site
///        may be another one; the triangle is exact.
/// \param positions 3 x n directions of any norm but 0; in the plane 2 x n, or 3 x n with z = 0, in
///        the unit of the mesh, and in a periodic direction at most 2^30 periods from the box.
/// \throws Error invalid_argument: another number of rows, a mesh without triangles, and with the
///         index of the position a z in the plane, or a distance above 2^30 periods, which a site
///         must not have either; not_finite and zero_vector (on the sphere), with the index of the
///         position.
Locations locate(const Mesh& mesh, const PointsRef& positions);

} // namespace calotte
CALOTTE_API_END
