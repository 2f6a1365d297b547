// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/multigrid.h"

#include "base/parallel.h"
#include "base/points.h"

#include <algorithm>
#include <utility>

namespace calotte::cvt_detail {
namespace {

constexpr Eigen::Index coarsest_rows = 300, aggregate_rows = 6;
constexpr double smoothing = 0.66, relaxation = 0.6; ///< of Jacobi's steps, in P and in the cycle

/// Row i of the matrix times each coordinate of x.
Vec3 row_times(const SparseMatrix& matrix, std::int64_t i, const Points3& x) {
  Vec3 sum{0, 0, 0};
  for (std::int32_t k = matrix.outerIndexPtr()[i]; k != matrix.outerIndexPtr()[i + 1]; ++k)
    sum = sum + matrix.valuePtr()[k] * column(x, matrix.innerIndexPtr()[k]);
  return sum;
}

template <class Value> Points3 by_rows(Eigen::Index rows, const Value& value) {
  Points3 result(3, rows);
  for_each_block(rows, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      set_column(result, i, value(i));
  });
  return result;
}

Points3 times(const SparseMatrix& matrix, const Points3& x) {
  return by_rows(matrix.rows(), [&](std::int64_t i) { return row_times(matrix, i, x); });
}

/// Six consecutive rows form one aggregate; the last aggregate takes the remainder.
SparseMatrix aggregation(Eigen::Index rows) {
  const Eigen::Index aggregates = std::max<Eigen::Index>(1, rows / aggregate_rows);
  SparseMatrix matrix(rows, aggregates);
  matrix.resizeNonZeros(rows);
  for (Eigen::Index i = 0; i <= rows; ++i)
    matrix.outerIndexPtr()[i] = static_cast<std::int32_t>(i);
  for (Eigen::Index i = 0; i < rows; ++i) {
    matrix.innerIndexPtr()[i] =
        static_cast<std::int32_t>(std::min(i / aggregate_rows, aggregates - 1));
    matrix.valuePtr()[i] = 1;
  }
  return matrix;
}

} // namespace

Multigrid::Multigrid(SparseMatrix matrix) {
  while (matrix.rows() > coarsest_rows) {
    Level level;
    level.inverse_diagonal = matrix.diagonal().cwiseInverse();
    const SparseMatrix pieces = aggregation(matrix.rows());
    const Eigen::VectorXd scale = smoothing * level.inverse_diagonal;
    const SparseMatrix smoothed = scale.asDiagonal() * SparseMatrix(matrix * pieces);
    level.prolongation = pieces - smoothed;
    level.restriction = level.prolongation.transpose();
    level.matrix.swap(matrix);
    matrix = level.restriction * SparseMatrix(level.matrix * level.prolongation);
    levels_.push_back(std::move(level));
  }
  factors_.compute(Eigen::SparseMatrix<double>(matrix));
}

Points3 Multigrid::cycle(std::size_t level, const Points3& right) const {
  if (level == levels_.size())
    return factors_.solve(Eigen::MatrixXd(right.transpose())).transpose();
  const Level& here = levels_[level];
  const SparseMatrix& matrix = here.matrix;
  const auto relaxing = [&](std::int64_t i, const Vec3& residual) {
    return (relaxation * here.inverse_diagonal[i]) * residual;
  };
  const auto relaxed = [&](const Points3& x) {
    return by_rows(matrix.rows(), [&](std::int64_t i) {
      return column(x, i) + relaxing(i, column(right, i) - row_times(matrix, i, x));
    });
  };
  Points3 x = by_rows(matrix.rows(), [&](std::int64_t i) { return relaxing(i, column(right, i)); });
  x = relaxed(x);
  const Points3 residual = by_rows(
      matrix.rows(), [&](std::int64_t i) { return column(right, i) - row_times(matrix, i, x); });
  const Points3 correction = cycle(level + 1, times(here.restriction, residual));
  x = by_rows(matrix.rows(), [&](std::int64_t i) {
    return column(x, i) + row_times(here.prolongation, i, correction);
  });
  return relaxed(relaxed(x));
}

} // namespace calotte::cvt_detail
