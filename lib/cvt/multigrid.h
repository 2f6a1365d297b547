// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/solvers.h"
#include "cvt/laplacian.h"
#include "cvt/room.h"

#include <cstdint>
#include <cstring>
#include <vector>

namespace calotte::cvt_detail {

/// Three coordinates and a zero, added by one instruction.
using Float4 [[gnu::vector_size(16)]] = float;

/// Vectors in single precision at a stride of some doubles, stored in memory of doubles.
class Column {
public:
  Column(const void* data, std::int64_t doubles)
      : data_(static_cast<const char*>(data)), stride_(doubles * 8) {}
  Float4 operator[](std::int64_t i) const {
    Float4 value;
    std::memcpy(&value, data_ + i * stride_, sizeof value);
    return value;
  }

private:
  const char* data_;
  std::int64_t stride_;
};

/// An approximate inverse of a symmetric, positive definite matrix of a mesh, in time proportional
/// to its size: one V-cycle of algebraic multigrid by smoothed aggregation (Vanek, Mandel and
/// Brezina, Computing 56, 1996), with coarse matrices that approximate that method's. An aggregate
/// is eight consecutive rows: the rows must be ordered along a space-filling curve. The inverse is
/// symmetric and positive definite itself, up to rounding: the cycle computes in single precision
/// with the matrix scaled to a diagonal of ones.
///
/// The smoother is symmetric Gauss-Seidel within fixed blocks of rows, and Jacobi between blocks.
class Multigrid {
public:
  explicit Multigrid(Laplacian matrix);

  /// Applies the cycle to three right sides at once, 3 x n; replaces them by the solutions.
  void solve(Points3& vectors);

private:
  using Vectors = Array<Float4>;

  struct Level {
    Rows weights;          ///< W, where the matrix is I - W
    Array<float> constant; ///< by row: the element of the column of its aggregate, not yet smoothed
    Vectors x, other;
    Vectors coarse_right; ///< the right side of the next level; that of the first is in the memory
                          ///< of the caller's vectors
  };

  const Vectors& solve(std::size_t level, Column right);
  static void restrict_residual(Level& level);
  const Vectors& solve_coarsest(Column right_side);

  Array<double> scale_; ///< by row: the inverse root of the diagonal
  std::vector<Level> levels_;
  Vectors coarsest_; ///< the solution there
  Cholesky factors_; ///< of the coarsest matrix
};

} // namespace calotte::cvt_detail
