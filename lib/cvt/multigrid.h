// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/laplacian.h"
#include "cvt/room.h"

#include <Eigen/SparseCholesky>

#include <vector>

namespace calotte::cvt_detail {

/// An approximate inverse of a symmetric, positive definite matrix of a mesh, in time proportional
/// to its size: one V-cycle of algebraic multigrid by smoothed aggregation (Vanek, Mandel and
/// Brezina, Computing 56, 1996). Aggregates are six rows that follow each other: the rows are to be
/// ordered along a space-filling curve. It is symmetric and positive definite itself.
class Multigrid {
public:
  /// \param matrix n x n, with every diagonal element and sorted rows.
  explicit Multigrid(SparseMatrix matrix);

  /// The cycle for the three coordinates at once, 3 x n.
  Points3 solve(const Points3& right) const { return cycle(0, right); }

private:
  struct Level {
    SparseMatrix matrix, prolongation, restriction;
    Eigen::VectorXd inverse_diagonal;
  };

  Points3 cycle(std::size_t level, const Points3& right) const;

  std::vector<Level> levels_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_; ///< of the coarsest
};

} // namespace calotte::cvt_detail
