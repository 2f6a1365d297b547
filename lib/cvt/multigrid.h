// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "cvt/laplacian.h"
#include "cvt/room.h"

#include <Eigen/SparseCholesky>

#include <cstdint>
#include <vector>

namespace calotte::cvt_detail {

/// A sparse matrix by rows, whose columns ascend.
template <class Value> struct Rows {
  Array<std::int32_t> begin; ///< of each row, and the end of the last
  Array<std::int32_t> column;
  Array<Value> value;

  std::int64_t size() const { return begin.size() - 1; }
};

/// An approximate inverse of a symmetric, positive definite matrix of a mesh, in time proportional
/// to its size: one V-cycle of algebraic multigrid by smoothed aggregation (Vanek, Mandel and
/// Brezina, Computing 56, 1996). Aggregates are six rows that follow each other: the rows are to be
/// ordered along a space-filling curve. It is symmetric and positive definite itself, but for
/// rounding: the cycle computes in single precision with the matrix scaled to a diagonal of ones.
class Multigrid {
public:
  /// \param matrix n x n, with every diagonal element and sorted rows.
  explicit Multigrid(SparseMatrix matrix);

  /// The cycle for the three coordinates at once, 3 x n.
  Points3 solve(const Points3& right);

private:
  /// Three coordinates and a zero, which one instruction adds.
  using Float4 [[gnu::vector_size(16)]] = float;
  using Vectors = Array<Float4>;

  struct Level {
    Rows<float> matrix, prolongation, restriction;
    Array<float> step; ///< of Jacobi's method: the relaxation over the diagonal
    Vectors right, x, other;
  };

  void cycle(std::size_t level);
  void solve_coarsest();

  Array<double> scale_; ///< by row: the inverse root of the diagonal
  std::vector<Level> levels_;
  Vectors coarsest_; ///< the right side, then the solution
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_; ///< of the coarsest matrix
};

} // namespace calotte::cvt_detail
