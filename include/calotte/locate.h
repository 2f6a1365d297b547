// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/mesh.h>

#include <memory>

CALOTTE_API_BEGIN
namespace calotte {

/// The locations of positions in a mesh; one element, or column, for each position.
struct Locations {
  /// The triangle that contains the position, the lowest of several: triangles include their edges
  /// and vertices. -1 outside of an open mesh. Exact.
  Ids triangle;
  /// 3 x n, barycentric: the position, or on the sphere its direction, is the sum of the triangle's
  /// vertices, unit vectors on the sphere, times the weights, up to a factor. From 0 to 1, their
  /// sum is 1; exactly 0 on the edge across. NaN outside.
  Triples weights;
  /// The nearest site, whose Voronoi cell contains the position; the lowest of those that are
  /// equally near. Exact in a Delaunay triangulation and in a part of one, also where sites have no
  /// triangle.
  Ids nearest;
};

/// Locates positions in a mesh. It is prepared once for many calls, which threads may make at the
/// same time. With a period the positions may lie outside of the box: their copies inside are
/// located.
///
///     const Locator locator(mesh);
///     const Locations before = locator.find(positions);
///     const Locations after = locator.find(moved, before.triangle);
///
/// From a triangle near a position a walk leads to it across edges that separate them (Lawson, in:
/// Mathematical Software III, 1977), for many positions in parallel. They are sorted along a
/// space-filling curve, and each walk begins where the previous one ended.
class Locator {
public:
  /// \param mesh a Delaunay triangulation, or a part of one. In a mesh that is none, the nearest
  ///        site may be another one; the triangle is exact. The locator and its copies refer to the
  ///        mesh, which must outlive them and stay as it is. They add 1 to 24 bytes a triangle, 1
  ///        to 4 if the mesh is closed; more once a position is beside the boundary of an open one,
  ///        or several sites are asked for.
  /// \throws Error invalid_argument: a mesh without triangles; in a plane, with its index, a site
  ///         that is more than 2^30 periods from the box.
  explicit Locator(const Mesh& mesh);
  explicit Locator(Mesh&& mesh) = delete; ///< the mesh must outlive the locator

  /// \param positions 3 x n directions of any norm but 0; in the plane 2 x n, or 3 x n with z = 0,
  ///        in the unit of the mesh, and in a periodic direction at most 2^30 periods from the box.
  /// \param hints for each position a triangle near it, such as an earlier result, or -1 for none.
  ///        They change no result in a Delaunay triangulation, and save little time: without hints
  ///        the previous position along the curve gives a triangle that is near, too. Default:
  ///        none.
  /// \throws Error invalid_argument: another number of rows or of hints; with the index of the
  ///         position a z in the plane, a distance above 2^30 periods, or a hint that is no
  ///         triangle; not_finite and zero_vector (on the sphere), with the index of the position.
  Locations find(const PointsRef& positions, const Ids& hints = {}) const;

  /// The same as find(...).nearest, in less time. \throws Error as find().
  Ids nearest(const PointsRef& positions, const Ids& hints = {}) const;

  /// The k nearest sites of each position, by distance; those that are equally near by id. Exact
  /// as Locations::nearest.
  /// \param positions as for find().
  /// \param k 1 or more; lists are shorter where there are fewer sites.
  /// \returns for each position a list of sites.
  /// \throws Error as find(); invalid_argument for another k.
  IdLists nearest_few(const PointsRef& positions, std::int64_t k) const;

  /// The sites within a distance of each position, ascending: of those whose distance is that up to
  /// rounding, some.
  /// \param positions as for find().
  /// \param distance 0 or more: an angle, at most pi, or in a plane in its unit.
  /// \returns for each position a list of sites, which may be empty.
  /// \throws Error as find(); invalid_argument for another distance.
  IdLists within(const PointsRef& positions, double distance) const;

private:
  struct Prepared;
  std::shared_ptr<const Prepared> prepared_;
};

/// The same as Locator(mesh).find(positions); faster for a single search in a mesh.
Locations locate(const Mesh& mesh, const PointsRef& positions);

} // namespace calotte
CALOTTE_API_END
