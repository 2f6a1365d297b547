// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// The library's dynamic matrices of doubles: Eigen's, with the option DontAlign. Their memory
/// comes from std::malloc whatever the instruction set that a file is compiled for, so it may be
/// freed on either side of the library's boundary. Eigen's other matrices convert to them, and from
/// them, by a copy.
using DoubleVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::DontAlign>;
using DoubleMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::DontAlign>;

/// 3 x n numbers, three a column.
using Triples = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::DontAlign>;

/// 3 x n, one Cartesian point a column. On the sphere a column is a *direction*: its norm has no
/// effect and must be from 1e-200 to 1e200. Every predicate is evaluated as if x/|x| were exactly
/// on the unit sphere. Zero and non-finite columns are errors; other norms out of range are not
/// detected.
using Points3 = Triples;

/// 2 x n, one Cartesian point x y a column, in any unit of length.
using Points2 = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::DontAlign>;

/// Points that a caller passes, 3 x n on the sphere or 2 x n in the plane, one Cartesian point a
/// column. Functions that take them check the number of rows at run time: Error bad_option.
///
/// Matrices of fixed or dynamic rows, aligned or not, their columns and blocks, and Eigen::Map are
/// read in place. Expressions, and matrices whose columns are not contiguous (transposed,
/// row-major), are evaluated into a temporary first. A std::vector<double> or
/// std::span<const double> of n points comes in as
///
///     Eigen::Map<const Eigen::Matrix3Xd>(values.data(), 3, n)    // x y z, x y z, ...
///     Eigen::Map<const Eigen::MatrixX3d>(values.data(), n, 3).transpose()  // all x, all y, all z
using PointsRef = Eigen::Ref<const DoubleMatrix>;

/// 3 x m 0-based ids, one triangle a column.
using Triangles = Eigen::Matrix<std::int32_t, 3, Eigen::Dynamic, Eigen::DontAlign>;

/// Ids of sites, triangles, cells, edges or vertices.
using Ids = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 1, Eigen::DontAlign>;

/// 2 x m ids, one pair a column.
using Pairs = Eigen::Matrix<std::int32_t, 2, Eigen::Dynamic, Eigen::DontAlign>;

/// Lists of n cells or polygons, such as neighbours or edges: the entries of cell i are begin[i] to
/// begin[i + 1] - 1.
using Offsets = Eigen::Matrix<std::int64_t, Eigen::Dynamic, 1, Eigen::DontAlign>;

/// A Delaunay triangulation of the unit sphere.
///
/// `triangles` run counter-clockwise seen from outside, start at their lowest vertex and are sorted
/// by their vertices, so that equal triangulations are equal arrays. `neighbours(i, t)` is the
/// triangle across from vertex i of triangle t (it shares the edge of the two other vertices), or
/// -1 along an open boundary. The mesh has an open boundary exactly when all sites lie in a closed
/// hemisphere; a closed mesh of n sites has 2n - 4 triangles.
struct Mesh {
  Points3 points;      ///< 3 x n sites: the distinct columns of the input, as given, in their order
  Triangles triangles; ///< 3 x m site ids
  Triangles neighbours; ///< 3 x m triangle ids, or -1
  std::vector<std::int32_t>
      site_of_input; ///< for each input column its site; a duplicate has the site of the lowest

  /// True if the number of triangles is that of a closed mesh.
  bool closed() const { return triangles.cols() == 2 * points.cols() - 4; }
};

/// A Delaunay triangulation in the plane: of the convex hull of the sites; of the doubly periodic
/// box [0, period.x) x [0, period.y); or of a channel, which is periodic in one direction and ends
/// at walls in the other. In a periodic direction the corners of a triangle are the nearest copies
/// of its sites. In the box n sites have 2n triangles; in a channel n sites, of which w are on the
/// walls, have 2n - w. Triangles and neighbours are as in Mesh.
struct PlanarMesh {
  Points2 points;                          ///< 2 x n sites; in a periodic direction in [0, period)
  Triangles triangles;                     ///< 3 x m site ids, counter-clockwise
  Triangles neighbours;                    ///< 3 x m triangle ids; -1 along an open boundary
  std::vector<std::int32_t> site_of_input; ///< as in Mesh
  Eigen::Vector2d period{0, 0}; ///< of the plane in x and y; 0 in a direction without one

  /// True if it covers a doubly periodic box; false in a channel, and in a box with land.
  bool closed() const { return period.minCoeff() > 0 && triangles.cols() == 2 * points.cols(); }
};

} // namespace calotte
CALOTTE_API_END
