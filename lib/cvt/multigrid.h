// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "cvt/laplacian.h"
#include "cvt/room.h"

#include <Eigen/SparseCholesky>

#include <cstdint>
#include <vector>

namespace calotte::cvt_detail {

/// Three coordinates and a zero, which one instruction adds.
using Float4 [[gnu::vector_size(16)]] = float;

/// An approximate inverse of a symmetric, positive definite matrix of a mesh, in time proportional
/// to its size: one V-cycle of algebraic multigrid by smoothed aggregation (Vanek, Mandel and
/// Brezina, Computing 56, 1996). Aggregates are eight rows that follow each other: the rows are to
/// be ordered along a space-filling curve. It is symmetric and positive definite itself, but for
/// rounding: the cycle computes in single precision with the matrix scaled to a diagonal of ones.
///
/// The smoother is Gauss and Seidel's method in fixed blocks of rows, forward and backward, and
/// Jacobi's between blocks.
class Multigrid {
public:
  explicit Multigrid(Laplacian matrix);

  /// The cycle for the three coordinates at once, 3 x n: replaces right sides by solutions.
  void solve(Points3& vectors);

private:
  using Vectors = Array<Float4>;

  struct Level {
    Rows weights;          ///< W, where the matrix is I - W
    Array<float> constant; ///< by row: the element of the column of its aggregate, not yet smoothed
    Vectors right, x, other;
  };

  void cycle(std::size_t level);
  void restrict_residual(const Level& level, Vectors& right);
  void solve_coarsest();

  Array<double> scale_; ///< by row: the inverse root of the diagonal
  std::vector<Level> levels_;
  Vectors coarsest_; ///< the right side, then the solution
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_; ///< of the coarsest matrix
};

} // namespace calotte::cvt_detail
