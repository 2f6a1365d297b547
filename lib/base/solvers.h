// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>

/// The solvers that the library takes from Eigen.
namespace calotte::base_detail {

/// The factors L D L^T of a small sparse matrix I - W, symmetric and positive definite.
class Cholesky {
public:
  Cholesky() = default;

  /// \param begin the offset of each row of W, and the end of the last.
  /// \param column, value the elements of W, row by row; its diagonal is zero.
  Cholesky(std::span<const std::int32_t> begin, std::span<const std::int32_t> column,
           std::span<const float> value);

  /// Replaces three right sides, one after the other, by the solutions.
  void solve(std::span<double> columns) const;

private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

/// The largest eigenvalue of a symmetric tridiagonal matrix.
/// \param beside the elements next to the diagonal, one fewer than those on it.
double largest_tridiagonal_eigenvalue(std::span<const double> diagonal,
                                      std::span<const double> beside);

} // namespace calotte::base_detail
