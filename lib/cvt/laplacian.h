// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
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

/// The most generators with a graph Laplacian, whose elements, at most 6 n on average, int32
/// counts.
constexpr std::int64_t most_laplacian_rows = std::numeric_limits<std::int32_t>::max() / 7;

/// A symmetric, positive definite matrix D (I - W) D, D diagonal and W with a diagonal of zeros.
struct Laplacian {
  Rows weights;        ///< W
  Array<double> scale; ///< 1/D
};

/// The sites of a mesh on a surface.
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
/// To it is added rho times the square of the site's area, a third of its triangles, over a 4 pi-th
/// of the surface, on the diagonal: a motion of all generators in one direction,
/// which costs the Laplacian nothing, is no symmetry of the sphere, nor of a clipped or refined
/// plane.
///
/// On a bounded surface the hull's points follow the generators. Where the boundary of a region
/// clips cells, circumcentres beyond half of an edge's length from it count as if they were there.
/// In the plane Voronoi edges beside the hull's points lie outside of the domain, and count for
/// nothing; a cell that the domain clips has on the diagonal 2 rho times the area between its
/// generator and the boundary: half of the trace of what the second derivative, 2 m less the
/// integrals over Voronoi edges, is when all generators move as one.
///
/// \param mesh the Delaunay triangulation of the sites.
/// \pre at most most_laplacian_rows generators.
template <Space S>
Laplacian graph_laplacian(const ClippedSites<S>& sites, const Connectivity& mesh,
                          const Density& density);

} // namespace calotte::cvt_detail
