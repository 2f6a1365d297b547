// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/domain.h>
#include <calotte/export.h>
#include <calotte/types.h>

#include <cstdint>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

struct Range {
  double min = 0, mean = 0, max = 0;
};

/// How good a closed mesh and its Voronoi cells are as a grid. Lengths are arcs on the unit sphere
/// in radians, areas are steradians; means weigh every edge, cell, triangle or corner alike. A
/// Voronoi edge joins the circumcentres of two triangles; it, or its continuation, crosses the
/// Delaunay edge between them at a right angle, in that one's midpoint.
struct Quality {
  std::int64_t cells = 0, triangles = 0;
  std::vector<std::int64_t> degrees; ///< at [d]: cells with d neighbours

  Range spacing; ///< of the Delaunay edges: length
  Range sigma;   ///< of the cells: distance to the nearest over that to the farthest neighbour
  /// Of the cells: shortest over longest Voronoi edge; 0 where cocircular sites share a corner.
  Range cell_quality;
  Range cell_area; ///< of the cells; max / min is the area ratio

  /// Of the triangles: (b + c - a) (c + a - b) (a + b - c) / (a b c) of the sides' arcs, 1 when
  /// equilateral; for chords it is twice the inscribed over the circumscribed circle's radius
  /// (Field, Int. J. Numer. Methods Eng. 47, 2000).
  Range triangle_quality;
  Range angles; ///< of the flat triangles' corners, degrees; their mean is 60
  /// Triangles with a flat angle over 90 degrees (by more than rounding, 1e-9): the circumcentre
  /// lies outside.
  std::int64_t obtuse = 0;

  /// Of the Voronoi edges: distance of the midpoint from the crossing above, over the edge's length
  /// (after Heikes and Randall, Mon. Weather Rev. 123, 1995). Over 1/2, the edge lies beside the
  /// Delaunay edge. Edges shorter than 1e-9 of the Delaunay edge are left out: cocircular sites
  /// share a corner and have no edge there.
  Range off_centring;

  /// sqrt( (1/n) sum |x_i - c_i|^2 ) over h = sqrt(4 pi / n), c_i = M/|M| the constrained centroid
  /// of the cell, M the integral of rho x: Norm::l2_scaled of the next step of Lloyd's iteration.
  double residual = 0;
  /// Sum over the cells of the integral of rho |x - x_i|^2. For uniform density n times that would
  /// be 5 (4 pi)^2 / (18 sqrt 3) = 25.325 if all cells were flat regular hexagons of one size.
  double energy = 0;

  double cells_area = 0, triangles_area = 0; ///< sums, over 4 pi: 1 but for rounding
};

/// Measures a mesh. Areas, and for uniform density the residual and the energy, are exact but for
/// rounding; for others these two come from the 6-point rule. The result is the same to the last
/// bit for any number of threads.
///
/// \param mesh the closed Delaunay triangulation of its points, directions of any norm.
/// \throws Error bad_option, for a mesh that fails check(); for an open one, whose cells do not
///         tessellate the sphere; for a density that is ill-formed, negative, infinite or NaN
///         somewhere, or zero over a whole cell.
Quality quality(const Mesh& mesh, const Density& density = {});

/// Measures a mesh of generators in a domain of the plane. Lengths and areas are in the domain's
/// unit, h = sqrt(area / n), and cells_area is over the domain's area; triangles_area is 0. Cells
/// are clipped by the domain: cell_area, residual and energy are of all; sigma, cell_quality and
/// degrees of the cells that the domain holds whole; triangles those with the circumcentre in it,
/// and edges theirs.
///
/// \param mesh the Delaunay triangulation of its points; of a periodic box, as that is.
/// \throws Error as above; bad_option as require_domain(), or for a generator outside.
Quality quality(const PlanarMesh& mesh, const PlanarDomain& domain, const Density& density = {});

} // namespace calotte
CALOTTE_API_END
