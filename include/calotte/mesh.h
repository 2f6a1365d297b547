// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/matrices.h>
#include <calotte/surface.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
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
  Triangles neighbours = {}; ///< 3 x m ids of triangles, or -1; those of sites: neighbours(mesh)
  /// For each input column its site. A duplicate has the site of the lowest equal column.
  std::vector<std::int32_t> site_of_input = {};
  /// Where the points live; in a plane its rings clip the Voronoi cells. Default: the sphere.
  Surface surface = {};

  /// True if the number of triangles is that of a closed mesh: of the sphere, or of the box.
  bool closed() const {
    return surface.is_sphere() ? triangles.cols() == 2 * points.cols() - 4
                               : surface.is_box() && triangles.cols() == 2 * points.cols();
  }
};

/// n polygons on the sphere, such as the cells of a grid that need not be Voronoi cells. Their
/// sides are arcs of great circles. Or n polygons in a plane, with z = 0. In a direction in which
/// the plane is periodic, the corners of a polygon are the copies nearest to its first corner.
struct Polygons {
  Points3 corners; ///< 3 x m unit columns; in a plane in any unit of length
  IdLists ids;     ///< 0-based corners of each polygon, counter-clockwise seen from outside
  Points3 centres; ///< 3 x n, as the corners; 3 x 0 if the file gives none
  /// The surface of the corners. Rings have no effect: the polygons are their own boundary.
  Surface surface = {};

  /// Their number.
  std::int64_t size() const { return ids.size(); }
};

/// The neighbours of each site of a mesh: the sites at the other ends of its edges,
/// counter-clockwise around it. Where the triangles surround a site, the list starts with the
/// lowest, as Voronoi::cells_on_cell does; at an open boundary with the one that the boundary leads
/// to, and it ends with the one that the boundary comes from. At a site where the boundary passes
/// more than once, the lists of its fans of triangles follow each other, in the order of their
/// first triangles. A site in no triangle has none. In a small periodic domain two sites may share
/// more than one edge, and are then neighbours as often. Linear time.
///
///     const IdLists around = neighbours(mesh);
///     for (const std::int32_t site : around[17])
///       distances.push_back((mesh.points.col(site) - mesh.points.col(17)).norm());
///
/// \param mesh as delaunay() or read_mesh() returns it; it may be open, and need not be Delaunay.
/// \throws Error invalid_argument for ids out of range, and neighbours that do not match the
///         triangles, with the index of the triangle.
IdLists neighbours(const Mesh& mesh);

/// The boundary of an open mesh: the sites of each closed loop of outer edges, with the mesh to the
/// left, seen from outside the sphere. A loop starts at its lowest site. At a site where the
/// boundary passes more than once, loops touch, and do not cross: it occurs in each of them, or
/// more than once in one. Linear time.
/// \param mesh as for neighbours().
/// \returns loops of three sites or more, by the lowest triangle at each; none for a closed mesh.
/// \throws Error as neighbours().
IdLists boundary_loops(const Mesh& mesh);

/// The order of the cells in a file.
enum class Numbering {
  by_format, ///< curve in NetCDF files, input in all others
  curve,     ///< along a space-filling curve
  input,     ///< the order of the sites in the mesh
};

/// The same mesh with its sites in another order and its triangles in canonical order. For a
/// Delaunay mesh the result is that of delaunay() for the permuted points. site_of_input maps each
/// input column to its new site. Numbering::curve keeps the order of sites that already follow the
/// curve. The time is linear.
/// \param mesh as delaunay() or read_mesh() returns it; it may be open.
/// \param numbering by_format and input return the mesh unchanged.
/// \throws Error invalid_argument for ids out of range, or neighbours that do not match the
///         triangles; with Numbering::curve not_finite and zero_vector (on the sphere), with the
///         index of the point.
Mesh renumbered(const Mesh& mesh, Numbering numbering);

/// The part of a mesh that a field belongs to.
enum class FieldLocation {
  cells, ///< the sites and their cells
  /// The pairs of sites that share an edge of a closed mesh, in the order of Voronoi: sorted by
  /// their lower site, then by their higher one.
  edges,
  /// The triangles, whose circumcentres are the corners of cells; for cells that are not Voronoi
  /// cells, their corners.
  vertices,
};

/// A dimension of a field besides that of its location, such as levels or times.
struct FieldDimension {
  std::string name;       ///< of the dimension
  std::int64_t size = 1;  ///< >= 1
  bool unlimited = false; ///< in a file, such as the times of a model's history
};

/// The choice of one index of a dimension of fields, such as a time or a level; see find_indices().
struct FieldIndex {
  std::string dimension;  ///< its name, in any case, or a part of it that no other one has
  std::int64_t index = 0; ///< from 0 on, or from the end: -1 is the last
};

/// Numbers for each cell, edge or vertex of a mesh, in its order.
struct MeshField {
  std::string name;                              ///< of the variable
  std::string long_name = {};                    ///< attribute in NetCDF files; empty for none
  std::string units = {};                        ///< attribute in NetCDF files; empty for none
  FieldLocation location = FieldLocation::cells; ///< what has the numbers
  /// count() numbers for the first cell, edge or vertex, then for the next; those of one in the
  /// order of `dimensions`, of which the last is the fastest. NaN where a file has its _FillValue.
  DoubleVector values = {};
  std::vector<FieldDimension> dimensions = {}; ///< none for one number for each
  /// The number of dimensions before the location's in a file: 1 for (Time, nCells, levels).
  int leading = 0;
  bool integer = false; ///< all are 32-bit integers, and NetCDF files store them as such
  bool single = false;  ///< NetCDF files store them as 32-bit floats; not of integers
  /// At edges: components along the edge's normal, from the lower to the higher site, or along its
  /// tangent. They change their sign where a numbering exchanges the two sites.
  bool directed = false;
  /// Other text attributes in NetCDF files, each a name and its text, that are valid for the
  /// numbers on any grid, such as standard_name and cell_methods.
  std::vector<std::array<std::string, 2>> attributes = {};

  /// Numbers for each cell, edge or vertex: the product of the dimensions' sizes.
  std::int64_t count() const {
    std::int64_t product = 1;
    for (const FieldDimension& dimension : dimensions)
      product *= dimension.size;
    return product;
  }
};

} // namespace calotte
CALOTTE_API_END
