// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/types.h>

#include <Eigen/SparseCore>

namespace calotte::detail {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

/// The graph Laplacian that approximates the second derivative of the CVT energy E, n x n, for each
/// coordinate of the generators: sum over edges of 2 w (e_i - e_j)(e_i - e_j)^T, w = rho times the
/// sum over both sides of (l^2 delta/4 - delta^3/3)/l, l the edge's length, delta the signed arc
/// from its midpoint to the circumcentre. That is half of the trace of E's mixed derivative, twice
/// the integral over the Voronoi edge of rho (x - x_i)(x - x_j)^T/l. Weights below a thousandth of
/// an equilateral triangle's are raised to that.
///
/// To it is added rho times the square of the cell's area on the diagonal: a motion of all
/// generators in one direction, which costs the Laplacian nothing, is no symmetry of the sphere.
///
/// \param points 3 x n unit columns that span the sphere.
SparseMatrix graph_laplacian(const Points3& points, const Density& density);

} // namespace calotte::detail
