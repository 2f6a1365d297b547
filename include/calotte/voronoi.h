// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cstdint>

CALOTTE_API_BEGIN
namespace calotte {

/// The Voronoi tessellation dual to a Delaunay triangulation, with the staggering of a C-grid model
/// (Ringler, Thuburn, Klemp and Skamarock, J. Comput. Phys. 229, 2010): cell i belongs to site i,
/// vertex t is the circumcentre of triangle t, and an edge is the pair of a Delaunay edge, which
/// joins two sites, and the dual Voronoi edge, which joins two vertices. Edges are sorted by their
/// lower cell, then by their higher cell. Ids are 0-based. All orders are counter-clockwise, on the
/// sphere seen from outside.
///
/// Lengths are arcs on the unit sphere in radians; areas are in steradians. In a plane lengths are
/// in the unit of the points and areas in its square, and z = 0. In a periodic plane points lie in
/// the box, and distances are those between nearest copies.
///
/// In a bounded surface the boundary clips the cells. The vertices are the circumcentres inside the
/// domain, then the ends of Voronoi edges on the boundary and its corners, ring by ring with the
/// domain to the left. Edges along the boundary have one cell; they follow the edges between two
/// cells, of which a pair may have several. A missing cell or edge has the id -1.
struct Voronoi {
  /// The surface that the cells cover: that of the mesh, whose rings clip the cells. Of a part
  /// that voronoi(mesh, mask) selects on the sphere, it is the sphere.
  Surface surface = {};

  Points3 cells; ///< 3 x n: the sites; unit columns on the sphere
  Points3 edges; ///< 3 x e: midpoints of the Delaunay edges, which the Voronoi edges cross; of an
                 ///< edge on the boundary its own
  Points3 vertices; ///< 3 x m: circumcentres

  /// n lists; all three have the same `begin`. Edge k of a cell lies between its vertices k - 1 and
  /// k. The first edge is the one towards the lowest neighbour.
  IdLists edges_on_cell;
  IdLists vertices_on_cell; ///< counter-clockwise
  IdLists cells_on_cell;    ///< neighbour k is across edge k, -1 on the boundary

  /// 3 x m: the mesh's triangles; on the boundary one or two cells, then -1.
  Triangles cells_on_vertex;
  /// 3 x m: cell j lies between edges j and j + 1. At a vertex of one cell the third is -1.
  Triangles edges_on_vertex;

  /// 2 x e: the lower and the higher cell; the normal points to the second. The second is -1 on the
  /// boundary, where the normal leaves the domain.
  Pairs cells_on_edge;
  Pairs vertices_on_edge; ///< 2 x e: to the right and to the left of that normal

  DoubleVector dc; ///< e: distance between the two cells; on the boundary sqrt(3) dv
  DoubleVector dv; ///< e: distance between the two vertices; 0 up to rounding for cocircular sites
  DoubleVector
      angle; ///< e: angle of the normal from east, -pi to pi; in the plane from x, [0, 2 pi)

  DoubleVector cell_area; ///< n
  /// m: area of the triangle, the sum of its kites; on the boundary, of the part inside the domain.
  DoubleVector vertex_area;
  /// 3 x m areas: kite j is the part of the triangle that is closest to its cell j, with the
  /// corners vertex, edge j, cell j, edge j + 1. Areas are signed: a part is negative if the
  /// circumcentre lies beyond its edge.
  Triples kites;
};

/// Computes the tessellation of a mesh's surface by the cells of its sites: of the sphere, of a
/// plane with two periods, or of the part of the sphere or of a plane that the surface's rings
/// bound, which clip the cells. Locations, lengths and areas are accurate to rounding; the areas
/// sum to that of the surface within 1e-12. For sites of the sphere closer than about 1e-12, and
/// for triangles as flat, only the sums are accurate. Unit columns keep their bits. The result has
/// the same bits for any number of threads. The function runs in the caller's task arena. Time: O(n
/// log n) for the cells, and for a boundary its edges and crossings times the degree of a cell.
///
/// On the sphere without rings, sites in a hemisphere have cells that reach round the far side of
/// the sphere. Their vertices there are the circumcentres of further triangles, the far
/// side of the sites' convex hull as points of the unit sphere, which cells_on_vertex and
/// edges_on_vertex contain, too: 2n - 4 in all. These run clockwise seen from outside the sphere.
/// \param mesh the Delaunay triangulation of its points: on the sphere directions of any norm, in a
///        bounded surface inside it or on its boundary. In a part of the sphere an open mesh, such
///        as a run's, may lack triangles: its points are triangulated anew. The function does not
///        check the Delaunay property; check() does.
/// \throws Error invalid_argument. In all cases: ids, neighbours or points that do not form a
///         triangulation, naming the first triangle or site; more than 2^29 sites, whose edges
///         exceed int32. On the sphere without rings: an open mesh whose boundary is not the hull
///         of its sites. In a part of the sphere: as delaunay(), for points of an open mesh. In a
///         plane without rings: other than two periods between 1e-30 and 1e30; a site outside the
///         box; a box so narrow that two cells share two edges. In a bounded surface, with the
///         index: the first point outside; the first cell that is no single polygon, because the
///         boundary cuts it into several parts or encloses an island in it; coastal_cells() makes
///         one of it.
Voronoi voronoi(const Mesh& mesh);

/// A part of the tessellation: the cells of some sites, with their edges and vertices. A cell that
/// is not kept is missing, -1, in the lists of its neighbours. Edges with one cell follow the
/// others; they keep their positions, and dc is the distance to the missing cell. Kites are those
/// of the kept cells.
///
///     write("area.nc", {.polygons = polygons_of(voronoi(mesh, mask))});
///
/// \param mesh the Delaunay triangulation of its points; on the sphere or in a plane without rings.
///        It may be open.
/// \param mask by site: >= 0 for cells that are kept, as limited_area_mask() and sea_cells() make
///        it of neighbours(mesh). The kept cells keep their order.
/// \throws Error invalid_argument: for another number of masks, or none >= 0; naming the first kept
///         site that triangles do not surround; as neighbours().
Voronoi voronoi(const Mesh& mesh, const Ids& mask);

/// The cells alone.
Polygons polygons_of(Voronoi voronoi);

/// TRiSK weights, which reconstruct the tangential velocity from the normal velocity: v_e is the
/// sum of weight times u_e' over the other edges e' of the two cells of e, first those of
/// cells_on_edge(0, e) counter-clockwise from e, then those of cells_on_edge(1, e). (Thuburn,
/// Ringler, Skamarock and Klemp, J. Comput. Phys. 228, 2009, Eq. 33.) The reconstruction conserves
/// energy, because weight dc_e / dv_e' is antisymmetric. The weights are 0 for a cell without area,
/// and for an edge between cells that coincide up to rounding. An edge on the boundary has the
/// weights of its one cell.
struct TangentialWeights {
  IdLists edges;        ///< of the k-th edge: the other edges e'
  DoubleVector weights; ///< one for each item of `edges`, without unit
};

/// The weights of edges first to last - 1. A caller may process a large mesh in parts.
/// \pre 0 <= first <= last <= number of edges.
TangentialWeights tangential_weights(const Voronoi& voronoi, std::int64_t first, std::int64_t last);

/// Scalar fields of the n cells, for pictures and files. Units are those of Voronoi.
struct CellFields {
  DoubleVector area; ///< as Voronoi::cell_area
  /// Density at the site, divided by its maximum over the sites; 1 if uniform.
  DoubleVector density;
  DoubleVector spacing; ///< mean of Voronoi::dc over the edges: distance to the neighbours
  DoubleVector quality; ///< shortest over longest Voronoi edge
  Ids degree;           ///< number of neighbours
};

/// Computes the fields.
/// \param density evaluated at the sites; in a plane uniform. Default: uniform.
/// \throws Error invalid_argument as evaluate(), and if the density is zero at every cell.
CellFields cell_fields(const Voronoi& voronoi, const Density& density = {});

/// The nominal spacing at the maximum of the density, for regular hexagonal cells with h ~
/// rho^(-1/4): sqrt(2/sqrt(3)/n sum area rho^(1/2)), with rho of CellFields. Radians on the sphere,
/// in a plane the unit of the points.
double nominal_spacing(const CellFields& fields);

/// An estimate of the density from the cells, for a mesh of unknown density: (h_min/h)^4, with h
/// the spacing of hexagons of a cell's area, smoothed over some two cells to remove the scatter of
/// single cells. Cells that lack a neighbour have the mean of their neighbours.
/// \returns n values, the maximum 1; none if the mesh is uniform: 90% of the smoothed spacings lie
///          within 10%, or most of the variation is scatter, as that of random sites.
DoubleVector spacing_density(const Voronoi& voronoi);

} // namespace calotte
CALOTTE_API_END
