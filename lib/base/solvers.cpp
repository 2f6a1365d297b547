// SPDX-License-Identifier: GPL-3.0-or-later

// Eigen's solvers have matrices of the default options as members. Eigen allocates these in another
// way in files that are compiled for AVX, and the linker keeps one copy of an inline function: a
// program of both kinds of files may allocate in one way and free in the other. So this file has
// Eigen under a name of its own, and includes no header that has it under its usual name. It is not
// precompiled.
#define Eigen calotte_eigen
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include "base/solvers.h"

#include <cstddef>
#include <vector>

namespace calotte::base_detail {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse matrix_of(std::span<const std::int32_t> begin, std::span<const std::int32_t> column,
                 std::span<const float> value) {
  const auto n = static_cast<std::int32_t>(begin.size() - 1);
  std::vector<Eigen::Triplet<double>> elements;
  for (std::int32_t i = 0; i != n; ++i) {
    elements.emplace_back(i, i, 1);
    for (auto k = static_cast<std::size_t>(begin[i]); k != static_cast<std::size_t>(begin[i + 1]);
         ++k)
      elements.emplace_back(i, column[k], -value[k]);
  }
  Sparse matrix(n, n);
  matrix.setFromTriplets(elements.begin(), elements.end());
  return matrix;
}

} // namespace

struct Cholesky::Factors {
  explicit Factors(const Sparse& matrix) : of(matrix) {}
  Eigen::SimplicialLDLT<Sparse> of;
};

Cholesky::Cholesky(std::span<const std::int32_t> begin, std::span<const std::int32_t> column,
                   std::span<const float> value)
    : factors_(std::make_shared<const Factors>(matrix_of(begin, column, value))) {}

void Cholesky::solve(std::span<double> columns) const {
  Eigen::Map<Eigen::MatrixXd> x(columns.data(), std::ssize(columns) / 3, 3);
  const Eigen::MatrixXd right = x, solution = factors_->of.solve(right);
  x = solution;
}

double largest_tridiagonal_eigenvalue(std::span<const double> diagonal,
                                      std::span<const double> beside) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(
      Eigen::Map<const Eigen::VectorXd>(diagonal.data(), std::ssize(diagonal)),
      Eigen::Map<const Eigen::VectorXd>(beside.data(), std::ssize(beside)), Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

} // namespace calotte::base_detail
