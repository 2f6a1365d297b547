// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/lists.h>
#include <calotte/matrices.h>
#include <calotte/surface.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// A Delaunay triangulation of the unit sphere, of the convex hull of points in the plane, of the
/// doubly periodic box [0, period.x) x [0, period.y), or of a channel, which is periodic in one
/// direction and ends at walls in the other.
///
/// `triangles` run counter-clockwise, on the sphere seen from outside, start at their lowest vertex
/// and are sorted by their vertices, so that equal triangulations are equal arrays.
/// `neighbours(i, t)` is the triangle across from vertex i of triangle t (it shares the edge of the
/// two other vertices), or -1 along an open boundary. On the sphere the mesh has an open boundary
/// exactly when all sites lie in a closed hemisphere; a closed mesh of n sites has 2n - 4
/// triangles. In a periodic direction the corners of a triangle are the nearest copies of its
/// sites. In the box n sites have 2n triangles; in a channel n sites, of which w are on the walls,
/// have 2n - w.
struct Mesh {
  /// 3 x n sites: the distinct columns of the input, as given, in their order. In the plane z = 0,
  /// in a periodic direction in [0, period).
  Points3 points = {};
  Triangles triangles = {};  ///< 3 x m site ids
  Triangles neighbours = {}; ///< 3 x m triangle ids, or -1
  /// For each input column its site; a duplicate has the site of the lowest.
  std::vector<std::int32_t> site_of_input = {};
  /// Where the points live; in a plane its rings clip the Voronoi cells. Default: the sphere.
  Surface surface = {};

  /// True if the number of triangles is that of a closed mesh: of the sphere, or of the box.
  bool closed() const {
    return surface.is_sphere() ? triangles.cols() == 2 * points.cols() - 4
                               : surface.is_box() && triangles.cols() == 2 * points.cols();
  }
};

} // namespace calotte
CALOTTE_API_END
