// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "cvt/repair.h"
#include "cvt/room.h"
#include "domain/surface.h"
#include "mesh/connectivity.h"

#include <calotte/density.h>
#include <calotte/matrices.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <limits>

namespace calotte::cvt_detail {

/// An element of a row of a sparse matrix.
struct Element {
  std::int32_t column;
  float value;
};

/// The rows of a sparse matrix; columns ascend.
using Rows = Lists<Array<Element>, Array<std::int32_t>>;

/// The maximum number of generators with a graph Laplacian: int32 counts its elements, at most 6 n
/// on average.
constexpr std::int64_t most_laplacian_rows = std::numeric_limits<std::int32_t>::max() / 7;

/// A symmetric, positive definite matrix D (I - W) D, D diagonal and W with a diagonal of zeros.
struct Laplacian {
  Rows weights;        ///< W
  Array<double> scale; ///< 1/D
};

/// The sites of a mesh on a surface that may be bounded.
template <Space S> struct ClippedSites {
  SitePositions<S> positions;
  std::int64_t generators;     ///< the first of them
  const OutlineOf<S>* outline; ///< of the surface; null without a boundary
  double area;                 ///< of the surface
};

/// The graph Laplacian that approximates the second derivative of the CVT energy E, n x n, for each
/// coordinate of the generators: sum over edges of 2 w (e_i - e_j)(e_i - e_j)^T, w = rho times the
/// sum over both sides of (l^2 delta/4 - delta^3/3)/l, l the edge's length, delta the signed arc
/// from its midpoint to the circumcentre. That is half of the trace of E's mixed derivative, twice
/// the integral over the Voronoi edge of rho (x - x_i)(x - x_j)^T/l. Weights below a thousandth of
/// an equilateral triangle's are raised to that.
///
/// The diagonal has a further term: rho times the squared area of the site (a third of its
/// triangles) over 1/(4 pi) of the surface's area. Without it, a motion of all generators in one
/// direction would have energy 0, which is no symmetry of the sphere, nor of a clipped or refined
/// plane.
///
/// On a bounded surface the hull's points follow the generators. Where the boundary of a region
/// clips cells, circumcentres beyond half of an edge's length from it count as if they were there.
/// In the plane, Voronoi edges beside the hull's points lie outside the domain and do not count. A
/// cell that the domain clips has a diagonal term of 2 rho times the area between its generator and
/// the boundary: half of the trace of the second derivative, 2 m less the integrals over Voronoi
/// edges, for a common motion of all generators.
///
/// \param mesh the Delaunay triangulation of the sites.
/// \pre at most most_laplacian_rows generators.
template <Space S>
Laplacian graph_laplacian(const ClippedSites<S>& sites, const Connectivity& mesh,
                          const Density& density);

} // namespace calotte::cvt_detail
