// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/room.h"

#include <calotte/voronoi.h>

/// The largest eigenvalues of the discrete Laplacians, by the method of Lanczos.
///
/// Both have a symmetric form: with areas A and weights w of the edges, the matrix of row i is the
/// sum over edges of w (y_i - y_j) / sqrt(A_i), with y = x / sqrt(A). Its largest eigenvalue is the
/// largest Ritz value of the Krylov space of a start of noise (Golub and Van Loan, Matrix
/// Computations, 10.1). Lost orthogonality repeats eigenvalues, but makes no larger ones.
namespace calotte::quality_detail {

/// The largest eigenvalue of the negative divergence of the gradient at cells: w = dv / dc. Edges
/// of one cell have no flux.
double primal_eigenvalue(const Voronoi& of);

/// The largest eigenvalue of the negative curl of the rotated gradient at vertices: w = dc / dv.
/// Edges of vertices without three cells do not count. Infinite if an edge has no length.
double dual_eigenvalue(const Voronoi& of);

} // namespace calotte::quality_detail
