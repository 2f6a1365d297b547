// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>
#include <calotte/voronoi.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Measures of a grid, and the errors that the operators of a C-grid model have on a mesh.
CALOTTE_API_BEGIN
namespace calotte {

/// A unit in which people read lengths and areas of the sphere.
struct Unit {
  std::string name;        ///< of lengths: "km", "degrees" or "radians"; "" in a plane
  double of_radian = 1;    ///< lengths: the value of one radian
  std::string area;        ///< of areas: "km^2" or "steradians"; "" in a plane
  double of_steradian = 1; ///< areas: the value of one steradian
};

/// The unit of a mesh of the sphere.
/// \param units km, degrees or radians. Default: km where the radius is known, else degrees.
/// \param radius_km of the sphere, if it is known, see MeshFile::planet_radius; > 0 and finite.
/// \throws Error invalid_argument for another word, for another radius, and for km without one.
Unit unit_of(const std::optional<std::string>& units, std::optional<double> radius_km);

/// Extremes and mean of a quantity; all 0 if there is nothing to measure.
struct ValueRange {
  double min = 0;  ///< the least value
  double mean = 0; ///< the mean
  double max = 0;  ///< the greatest value
};

/// Extremes and percentiles of a quantity: the least value that occurs such that 1, 5, 50, 95 and
/// 99 percent of all values are not above it. All 0 if there is nothing to measure.
struct Percentiles {
  double min = 0; ///< the least value
  double p1 = 0;  ///< 1 percent
  double p5 = 0;  ///< 5 percent
  double p50 = 0; ///< the median
  double p95 = 0; ///< 95 percent
  double p99 = 0; ///< 99 percent
  double max = 0; ///< the greatest value
};

/// Limits beyond which models object to an edge.
inline constexpr double short_voronoi_edge = 0.18; ///< of dv/dc
inline constexpr double shortest_dc_over_h = 0.75; ///< dc/h of the shortest edge that fits
inline constexpr double longest_dc_over_h = 1.4;   ///< dc/h of the longest

/// Quality of a mesh and its Voronoi cells. On the sphere lengths are arcs in radians, and areas
/// are in steradians; in a plane lengths are in the unit of the points, and areas in its square.
/// Means give equal weight to every edge, cell, triangle or corner. A Voronoi edge joins the
/// circumcentres of two triangles. It, or its extension, bisects the Delaunay edge between them at
/// a right angle.
struct Quality {
  std::int64_t cells = 0;     ///< their number
  std::int64_t triangles = 0; ///< their number
  /// Triangles along an open boundary that are flat up to rounding, such as those between sites on
  /// one meridian, which lie on one great circle except for their last digits. They do not count.
  std::int64_t flat = 0;
  std::vector<std::int64_t> degrees; ///< degrees[d]: number of cells with d neighbours

  ValueRange spacing; ///< length of the Delaunay edges
  ValueRange sigma;   ///< per cell: distance to the nearest neighbour / distance to the farthest
  /// Per cell: shortest Voronoi edge / longest; 0 where cocircular sites share a corner.
  ValueRange cell_quality;
  ValueRange cell_area; ///< per cell; max / min is the area ratio

  /// Per triangle: (b + c - a) (c + a - b) (a + b - c) / (a b c), with a, b, c the arcs of the
  /// sides; 1 if equilateral. With chords it is twice the inradius divided by the circumradius
  /// (Field, Int. J. Numer. Methods Eng. 47, 2000).
  ValueRange triangle_quality;
  ValueRange angles; ///< angles of the flat triangles, degrees; the mean is 60
  /// Number of triangles with a flat angle above 90 degrees by more than rounding (1e-9). Their
  /// circumcentre lies outside.
  std::int64_t obtuse = 0;

  /// Per Voronoi edge: distance between its midpoint and that of the Delaunay edge, divided by its
  /// length (after Heikes and Randall, Mon. Weather Rev. 123, 1995). Above 1/2 the two edges do not
  /// cross. Voronoi edges shorter than 1e-9 of the Delaunay edge do not count; cocircular sites
  /// share a corner there.
  ValueRange off_centring;

  /// sqrt( (1/n) sum |x_i - c_i|^2 ) / h with h = sqrt(area / n), on the sphere sqrt(4 pi / n). c_i
  /// = M/|M| is the constrained centroid of the cell, M the integral of rho x. It equals
  /// Norm::l2_scaled of the next Lloyd step.
  double residual = 0;
  /// Sum over the cells of the integral of rho |x - x_i|^2. For uniform density, n times the energy
  /// of flat regular hexagons of equal size is 5 (4 pi)^2 / (18 sqrt 3) = 25.325.
  double energy = 0;

  /// Energy times n of flat regular hexagons of equal integrals of rho^(1/2), 5/(18 sqrt 3)
  /// (integral of rho^(1/2))^2: the limit of a CVT of many cells (Gersho, IEEE Trans. Inf. Theory
  /// 25, 1979). In a plane, the integral over the domain.
  double limit = 0;
  double excess = 0; ///< energy n / limit - 1

  /// Per edge: its length (the distance dc between two cells) over the spacing h = sqrt(2/(sqrt(3)
  /// n) integral of rho^(1/2)) rho^(-1/4) that the density demands of n cells; 1/h is the mean of
  /// the two ends.
  Percentiles dc_over_h;
  /// Per edge: length dv of the Voronoi edge over that of the Delaunay edge, both arcs on the
  /// sphere; 1/sqrt(3) for regular hexagons, 0 where cocircular sites share a corner.
  ValueRange dv_over_dc;
  std::int64_t short_edges = 0; ///< number of edges with dv/dc below short_voronoi_edge
  /// Number of edges with dc/h outside shortest_dc_over_h to longest_dc_over_h.
  std::int64_t mismatched_edges = 0;
  /// Number of cells that a model may object to: with a side or a neighbour counted above, or with
  /// a corner that is the centre of an obtuse triangle.
  std::int64_t bad_cells = 0;
  ValueRange bad_spacing; ///< mean distance of each of these cells to its neighbours

  double cells_area = 0;     ///< sum of areas over that of the surface; 1 up to rounding
  double triangles_area = 0; ///< sum of the triangles' areas / 4 pi; in a plane 0
};

/// Measures a mesh of the whole sphere, of a box, or of a part of the plane, whose rings clip the
/// cells. Areas are exact up to rounding, and so are the residual, the energy and its limit for
/// uniform density; for other densities these use the 6-point rule. The result has the same bits
/// for any number of threads.
///
/// In a part of the plane cell_area, residual and energy include all cells; sigma, cell_quality,
/// degrees and bad_cells only the unclipped ones. Triangles are those with their circumcentre
/// inside; edges are theirs, and a Voronoi edge counts if it joins two of them.
///
/// \param mesh the Delaunay triangulation of its points: on the sphere closed, of directions of any
///        norm; in a part of the plane of points inside it or on its boundary.
/// \param density default: uniform.
/// \throws Error invalid_argument, for a mesh that fails check(); for an open mesh of the sphere,
///         whose cells do not cover it, see open_quality(); for a plane without rings and two
///         periods; with the index of a point outside its surface; for a density that is
///         ill-formed, negative, infinite or NaN somewhere, or zero over a whole cell.
Quality quality(const Mesh& mesh, const Density& density = {});

/// Measures the triangles of a mesh that need be neither closed nor Delaunay; rings of its surface
/// have no effect: triangles, flat (on the sphere), spacing, triangle_quality, angles, obtuse and
/// triangles_area. `cells` is the number of sites, and `degrees` counts the sites with a closed
/// ring of triangles. The other fields, which belong to Voronoi cells, stay 0.
/// \throws Error invalid_argument, for a mesh that fails check_surface().
Quality triangle_quality(const Mesh& mesh);

/// Measures an open Delaunay triangulation, such as that of a limited-area grid or of a channel:
/// what triangle_quality() measures, and the Voronoi cells as far as triangles surround them. Edges
/// of two triangles have dv_over_dc, off_centring and short_edges. Sites with a closed ring of
/// triangles have sigma, cell_quality, cell_area, bad_cells (by short edges and obtuse triangles
/// alone) and bad_spacing; cells_area is the sum of their areas over 4 pi, in a plane 0.
/// \pre no edge but those whose opposite sites are cocircular fails to be Delaunay: see
///      count_edges().
/// \throws Error invalid_argument, for a mesh that fails check_surface().
Quality open_quality(const Mesh& mesh);

/// The shapes to which models object, as Quality counts them.
struct BadShapes {
  std::int64_t obtuse = 0;      ///< triangles with an obtuse angle
  std::int64_t short_edges = 0; ///< Voronoi edges below short_voronoi_edge times the Delaunay edge
};

/// Counts them, of a closed mesh of the sphere without the arrays of quality().
/// \param mesh as of quality(), or open as of open_quality().
/// \pre of a closed mesh of the sphere: unit columns, Delaunay.
/// \throws Error as these.
BadShapes count_bad_shapes(const Mesh& mesh);

/// The measures of Quality for each cell and triangle, for maps and lists. Lengths are arcs on the
/// unit sphere in radians and areas steradians, or in the unit of a plane and its square. NaN where
/// a cell has no such measure: sigma, quality and area at sites that triangles do not surround, and
/// at all sites of a mesh that is not Delaunay; degree at the former sites, too.
struct CellMeasures {
  DoubleVector spacing;       ///< n: mean length of the Delaunay edges at the site
  DoubleVector area;          ///< n
  DoubleVector sigma;         ///< n: shortest over longest of these edges
  DoubleVector quality;       ///< n: shortest over longest Voronoi edge
  DoubleVector degree;        ///< n: number of neighbours
  DoubleVector largest_angle; ///< n: of the triangles at the site, degrees
  /// n: distance of the site from the constrained centroid of its cell, over spacing. NaN for an
  /// open mesh.
  DoubleVector off_centroid;
  /// n: the spacing h that the density demands of n cells, see Quality::dc_over_h. Empty for an
  /// open mesh.
  DoubleVector prescribed;
  DoubleVector min_dc_over_h;    ///< n: least dc/h of the edges at the site; or empty
  DoubleVector max_dc_over_h;    ///< n: greatest dc/h of these edges; or empty
  DoubleVector triangle_angle;   ///< m: largest angle, degrees
  DoubleVector triangle_quality; ///< m: as Quality::triangle_quality
};

/// Measures the cells and triangles of a mesh. A mesh of the sphere may be open, and need not be
/// Delaunay. The rings of a part of the plane clip the cells: clipped ones have no degree, sigma
/// and quality; triangles whose circumcentre lies outside have no values.
/// \param mesh in the plane as in quality().
/// \param density as in quality(); without effect on an open mesh of the sphere.
/// \throws Error invalid_argument, for a mesh that fails check_surface(); for a density as
///         quality(); in the plane as quality() and voronoi().
CellMeasures cell_measures(const Mesh& mesh, const Density& density = {});

/// For each site, whether the boundary of the mesh's surface clips its cell or the site lies
/// outside. quality() leaves these cells out of `degrees`. The whole sphere and a box clip no cell.
/// \param mesh its points and its surface only.
/// \throws Error invalid_argument for a region of the sphere, whose cells quality() does not clip,
///         and for a plane without rings and two periods.
std::vector<bool> clipped_cells(const Mesh& mesh);

/// Norms of an error over cells, edges or vertices; all 0 if there is nothing to measure.
struct ErrorNorms {
  double l2 = 0;  ///< root of the mean square
  double max = 0; ///< the greatest value
  /// A cell at the greatest value: the cell itself, the lower cell of an edge, the
  /// first of a vertex; -1 if there is none.
  std::int64_t cell = -1;
  Eigen::Vector3d position{0, 0, 0}; ///< of the greatest value: a unit vector; in the plane z = 0
};

/// Errors by cell, relative as in OperatorErrors. A cell has the greatest error of its edges or
/// vertices. NaN where a stencil is not complete.
struct OperatorErrorsByCell {
  DoubleVector divergence;     ///< n
  DoubleVector gradient;       ///< n; of its edges
  DoubleVector laplacian;      ///< n
  DoubleVector curl;           ///< n; of its vertices
  DoubleVector tangential;     ///< n; of its edges
  DoubleVector kinetic_energy; ///< n
};

/// The quality of a mesh for a C-grid model: errors of the operators of TRiSK (Ringler, Thuburn,
/// Klemp and Skamarock, J. Comput. Phys. 229, 2010) for smooth fields, and their stability.
///
/// The scalars s are harmonics of one norm: on the sphere the five real ones of degree 2, x y, y z,
/// z x, (x^2 - y^2)/2 and (3 z^2 - 1)/(2 sqrt 3), so that a rotation of the mesh leaves the errors
/// of linear operators; in the plane the cosine and the sine of the longest wave in x and in y, in
/// the periodic box or in the box around a bounded domain. The velocities are grad s and k x grad
/// s. Discrete fields are values at the sites, and normal components at the edges' midpoints; the
/// result is compared with the exact values at the site, the edge's midpoint or the vertex.
///
/// The error at a point is the root of the sum over all fields of squared errors. l2 is its root
/// mean square, weighted by area (of an edge dc dv), and both norms are divided by the root mean
/// square of the exact values. Only points with a complete stencil count: cells that no boundary
/// clips, edges between two of them, vertices between three.
struct OperatorErrors {
  ErrorNorms divergence;     ///< of a velocity, at cells
  ErrorNorms gradient;       ///< of a scalar, at edges
  ErrorNorms laplacian;      ///< divergence of the gradient, at cells
  ErrorNorms curl;           ///< of a velocity, at vertices
  ErrorNorms tangential;     ///< velocity along an edge, by tangential_weights()
  ErrorNorms kinetic_energy; ///< at cells: the sum over edges of dc dv u^2 / 4, over the area

  /// Distance of a site from the centroid of its cell, over the mean distance to its neighbours.
  ErrorNorms off_centroid;
  /// Distance between the midpoints of a Delaunay edge and of its Voronoi edge, over dc.
  ErrorNorms off_midpoint;

  /// Largest eigenvalue of the negative Laplacian at cells (divergence of the gradient), within 1
  /// percent, over the square of the unit of length. It bounds the time step of gravity waves and
  /// of the diffusion of divergence.
  double primal_eigenvalue = 0;
  /// The same at vertices: curl of the rotated gradient. It bounds the time step of the diffusion
  /// of vorticity. Short Voronoi edges raise it; infinite where one has no length.
  double dual_eigenvalue = 0;

  OperatorErrorsByCell by_cell; ///< the errors of each cell
};

/// The longest stable step of gravity waves with the classical Runge-Kutta method of order 4:
/// sqrt(8) / (speed sqrt(eigenvalue)).
/// \param speed sqrt(g H), in the unit of length a unit of time.
inline double wave_step(const OperatorErrors& errors, double speed) {
  return std::sqrt(8 / errors.primal_eigenvalue) / speed;
}

/// The longest stable step of a diffusion with Euler's forward method: 2 / (viscosity eigenvalue).
/// \param eigenvalue OperatorErrors::primal_eigenvalue for divergence, dual_eigenvalue for
///        vorticity.
/// \param viscosity in the square of the unit of length a unit of time.
inline double diffusion_step(double eigenvalue, double viscosity) {
  return 2 / (viscosity * eigenvalue);
}

/// Measures a mesh of the sphere, in radians, or of a box or a bounded part of the plane, in the
/// unit of the points. Of an open mesh of the sphere, such as a limited area, it measures the cells
/// that triangles surround. The result has the same bits for any number of threads.
/// \param mesh the Delaunay triangulation of its points: on the sphere directions of any norm, in
///        the plane as in quality().
/// \param density weights the centroids, as in quality(). Default: uniform. Without effect on an
///        open mesh of the sphere.
/// \throws Error invalid_argument as voronoi() and quality(), but open meshes of the sphere are
///         measured; for a mesh that fails check_surface() or has edges that are not Delaunay, see
///         count_edges(); for an open mesh of the sphere no site of which is surrounded by
///         triangles.
OperatorErrors operator_errors(const Mesh& mesh, const Density& density = {});

} // namespace calotte
CALOTTE_API_END
