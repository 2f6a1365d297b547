// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/types.h>

#include <cstdint>

CALOTTE_API_BEGIN
namespace calotte {

/// Ids of cells, edges or vertices.
using Ids = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 1>;

/// 2 x m ids, one pair a column.
using Pairs = Eigen::Matrix<std::int32_t, 2, Eigen::Dynamic>;

/// The Voronoi tessellation dual to a Delaunay triangulation, as a C-grid model staggers it
/// (Ringler, Thuburn, Klemp and Skamarock, J. Comput. Phys. 229, 2010): cell i is that of site i,
/// vertex t the circumcentre of triangle t, and an edge is a pair of a Delaunay edge, which joins
/// two sites, and the Voronoi edge across it, which joins two vertices. Edges are numbered by their
/// lower cell, then by their higher one. Ids are 0-based, and all orders counter-clockwise, on the
/// sphere seen from outside.
///
/// Lengths are arcs on the unit sphere, areas steradians. In a periodic plane they are in the units
/// of the points and their squares, places lie in the box with z = 0, and differences are taken
/// between nearest copies.
struct Voronoi {
  bool on_sphere = true;
  Eigen::Vector2d period{0, 0}; ///< of the plane; 0 on the sphere

  Points3 cells;    ///< 3 x n: the sites, unit columns on the sphere
  Points3 edges;    ///< 3 x e: midpoints of the Delaunay edges, where these cross the Voronoi edges
  Points3 vertices; ///< 3 x m: circumcentres

  /// Of cell i, at begin[i] to begin[i + 1] of the next three: edge k lies between vertices k - 1
  /// and k, and neighbour k across it; from the edge to the lowest neighbour on.
  Eigen::Matrix<std::int64_t, Eigen::Dynamic, 1> begin; ///< n + 1
  Ids edges_on_cell, vertices_on_cell, cells_on_cell;

  Triangles cells_on_vertex; ///< 3 x m: the mesh's triangles
  Triangles edges_on_vertex; ///< 3 x m: cell j lies between edges j and j + 1

  Pairs cells_on_edge;    ///< 2 x e: the lower and the higher cell; the normal points to the second
  Pairs vertices_on_edge; ///< 2 x e: to the right and to the left of that normal

  Eigen::VectorXd dc; ///< e: distance of the cells
  Eigen::VectorXd
      dv; ///< e: distance of the vertices; 0 but for rounding where sites are cocircular
  Eigen::VectorXd
      angle; ///< e: of the normal from east (in the plane from x), -pi to pi ([0, 2 pi))

  Eigen::VectorXd cell_area;   ///< n
  Eigen::VectorXd vertex_area; ///< m: of the triangles, each the sum of its kites
  /// 3 x m: kite j is the part of the triangle nearer to its cell j: vertex, edge j, cell j, edge
  /// j + 1. Signed: parts across an edge that the circumcentre lies beyond count as negative.
  Eigen::Matrix3Xd kites;
};

/// The tessellation dual to a closed mesh. Places, lengths and areas are good to rounding: areas
/// sum to 4 pi within 1e-12. Of sites nearer than some 1e-12, and of triangles as flat, nothing but
/// the sums is. A unit column keeps its bits. The same bits for any number of threads; it runs in
/// the caller's task arena.
/// \param mesh the closed Delaunay triangulation of its points, directions of any norm. Whether it
///        is Delaunay is not checked.
/// \throws Error bad_option, for an open mesh, whose outer cells are unbounded; for one whose ids,
///         neighbours or points are none of a triangulation, naming the first triangle or site; for
///         more than 2^29 sites, whose edges int32 cannot count.
Voronoi voronoi(const Mesh& mesh);
/// \throws Error bad_option, for a box without area; for a site outside it; for one so narrow that
///         two cells share two edges; and as above.
Voronoi voronoi(const PlanarMesh& mesh);

/// Weights that reconstruct the tangential from the normal velocity, v_e = sum of weight times u_e'
/// over the other edges e' of the two cells of e: those of cells_on_edge(0, e) counter-clockwise
/// from e on, then of cells_on_edge(1, e). (Thuburn, Ringler, Skamarock and Klemp, J. Comput. Phys.
/// 228, 2009, Eq. 33.) Energy is kept as weight dc_e / dv_e' is antisymmetric. Of a cell without
/// area, and of an edge between cells that are one but for rounding, the weights are 0.
struct TangentialWeights {
  Eigen::Matrix<std::int64_t, Eigen::Dynamic, 1>
      begin; ///< those of the k-th edge: from begin[k] on
  Ids edges;
  Eigen::VectorXd weights;
};

/// Of edges first to last - 1, so that those of a large mesh need not be kept all at once.
/// \pre 0 <= first <= last <= edges.
TangentialWeights tangential_weights(const Voronoi& voronoi, std::int64_t first, std::int64_t last);

/// What a picture or a model's file shows of the cells, n of each.
struct CellFields {
  Eigen::VectorXd area;    ///< as Voronoi::cell_area
  Eigen::VectorXd density; ///< at the cells, over the greatest of these; 1 for uniform density
  Eigen::VectorXd spacing; ///< mean distance to the neighbours
  Eigen::VectorXd quality; ///< shortest over longest Voronoi edge
  Ids degree;              ///< number of neighbours
};

/// In a plane the density must be uniform. \throws Error bad_option, as evaluate(), and where the
/// density is zero at every cell.
CellFields cell_fields(const Voronoi& voronoi, const Density& density = {});

/// The spacing where the density is greatest, were all cells regular hexagons of sides that follow
/// h ~ rho^(-1/4): sqrt(2/sqrt(3)/n sum area rho^(1/2)), rho as in CellFields.
double nominal_spacing(const CellFields& fields);

} // namespace calotte
CALOTTE_API_END
