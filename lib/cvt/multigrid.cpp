// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/multigrid.h"

#include "base/parallel.h"
#include "base/points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace calotte::cvt_detail {
namespace {

constexpr std::int64_t coarsest_rows = 300, aggregate_rows = 6;
constexpr double smoothing = 0.66, relaxation = 0.6; ///< of Jacobi's steps, in P and in the cycle

std::int64_t aggregates_of(std::int64_t rows) {
  return std::max<std::int64_t>(1, rows / aggregate_rows);
}

/// Six consecutive rows form one aggregate; the last aggregate takes the remainder.
std::int32_t aggregate_of(std::int64_t row, std::int64_t aggregates) {
  return static_cast<std::int32_t>(std::min(row / aggregate_rows, aggregates - 1));
}

// ---- Set-up, in double precision

/// The sums of values by column, one row after the other, at the ends of two lists.
class RowSums {
public:
  /// \param expected number of elements.
  RowSums(std::int64_t width, std::int64_t expected) : place_(zeros<std::uint32_t>(width)) {
    reserve_huge(columns, expected);
    reserve_huge(values, expected);
  }

  std::vector<std::int32_t> columns;
  std::vector<double> values;

  void begin_row() { first_ = columns.size(); }

  /// Adds a value to the row. Columns stand in the order in which they first come.
  void add(std::int32_t column, double value) {
    std::uint32_t& place = place_[static_cast<std::size_t>(column)];
    if (place >= first_ && place < columns.size() && columns[place] == column) {
      values[place] += value;
      return;
    }
    place = static_cast<std::uint32_t>(columns.size());
    columns.push_back(column);
    values.push_back(value);
  }

private:
  std::vector<std::uint32_t> place_; ///< by column: where it stands, if it is in the row
  std::size_t first_ = 0;            ///< of the row
};

/// Builds a matrix from parts that are computed side by side.
/// \param expected number of elements of a row.
/// \param set_row(row, sums) adds the elements of a row.
template <class SetRow>
Rows<double> make_rows(std::int64_t rows, std::int64_t columns, std::int64_t expected,
                       const SetRow& set_row) {
  constexpr std::int64_t most_parts = 64; // each with a place for every column
  const std::int64_t parts = std::min(most_parts, block_count(rows));
  Rows<double> out;
  out.begin = Array<std::int32_t>(rows + 1);
  std::vector<RowSums> part;
  std::vector<std::int64_t> first(static_cast<std::size_t>(parts) + 1, 0);
  part.reserve(static_cast<std::size_t>(parts));
  for (std::int64_t k = 0; k < parts; ++k)
    part.emplace_back(0, 0);
  const auto begin_of = [&](std::int64_t k) { return rows * k / parts; };
  for_each_task(parts, [&](std::int64_t k) {
    RowSums sums(columns, expected * (begin_of(k + 1) - begin_of(k)));
    for (std::int64_t i = begin_of(k); i != begin_of(k + 1); ++i) {
      out.begin[i] = static_cast<std::int32_t>(sums.columns.size());
      sums.begin_row();
      set_row(i, sums);
    }
    first[static_cast<std::size_t>(k) + 1] = std::ssize(sums.columns);
    part[static_cast<std::size_t>(k)] = std::move(sums);
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  out.begin[rows] = static_cast<std::int32_t>(first.back());
  out.column = Array<std::int32_t>(first.back());
  out.value = Array<double>(first.back());
  for_each_task(parts, [&](std::int64_t k) {
    const RowSums& sums = part[static_cast<std::size_t>(k)];
    const std::int64_t to = first[static_cast<std::size_t>(k)];
    for (std::int64_t i = begin_of(k); i != begin_of(k + 1); ++i)
      out.begin[i] += static_cast<std::int32_t>(to);
    std::copy(sums.columns.begin(), sums.columns.end(), out.column.begin() + to);
    std::copy(sums.values.begin(), sums.values.end(), out.value.begin() + to);
  });
  return out;
}

Rows<double> product(const Rows<double>& left, const Rows<double>& right, std::int64_t columns,
                     std::int64_t expected) {
  return make_rows(left.size(), columns, expected, [&](std::int64_t i, RowSums& sums) {
    for (std::int32_t k = left.begin[i]; k != left.begin[i + 1]; ++k) {
      const std::int32_t row = left.column[k];
      for (std::int32_t j = right.begin[row]; j != right.begin[row + 1]; ++j)
        sums.add(right.column[j], left.value[k] * right.value[j]);
    }
  });
}

/// The elements on the diagonal.
Array<double> diagonal_of(const Rows<double>& matrix) {
  Array<double> diagonal(matrix.size());
  for_each_block(matrix.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      for (std::int32_t k = matrix.begin[i]; k != matrix.begin[i + 1]; ++k)
        if (matrix.column[k] == i)
          diagonal[i] = matrix.value[k];
  });
  return diagonal;
}

/// The norm, by aggregate, of the vector that the matrix almost maps to zero.
Array<double> norms_of_aggregates(const Array<double>& constant) {
  const std::int64_t rows = constant.size(), aggregates = aggregates_of(rows);
  Array<double> norms(aggregates);
  for_each_block(aggregates, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a != end; ++a) {
      const std::int64_t last = a + 1 == aggregates ? rows : aggregate_rows * (a + 1);
      double sum = 0;
      for (std::int64_t i = aggregate_rows * a; i != last; ++i)
        sum += constant[i] * constant[i];
      norms[a] = std::sqrt(sum);
    }
  });
  return norms;
}

/// Smoothed aggregation: one of Jacobi's steps on the columns that hold that vector, piece by
/// piece.
Rows<double> prolongation_of(const Rows<double>& matrix, const Array<double>& diagonal,
                             const Array<double>& constant, const Array<double>& norms) {
  return make_rows(matrix.size(), norms.size(), 5, [&](std::int64_t i, RowSums& sums) {
    for (std::int32_t k = matrix.begin[i]; k != matrix.begin[i + 1]; ++k) {
      const std::int32_t j = matrix.column[k], a = aggregate_of(j, norms.size());
      const double share = (j == i ? 1 : 0) - smoothing / diagonal[i] * matrix.value[k];
      sums.add(a, share * constant[j] / norms[a]);
    }
  });
}

/// The transpose of a prolongation. The rows with an element in an aggregate's column are the
/// neighbours of its rows, as the matrix is symmetric.
Rows<double> transposed(const Rows<double>& prolongation, const Rows<double>& matrix,
                        std::int64_t aggregates) {
  const std::int64_t rows = matrix.size();
  return make_rows(aggregates, rows, 30, [&](std::int64_t a, RowSums& sums) {
    const std::int64_t last = a + 1 == aggregates ? rows : aggregate_rows * (a + 1);
    const std::size_t first = sums.columns.size();
    for (std::int32_t k = matrix.begin[aggregate_rows * a]; k != matrix.begin[last]; ++k)
      sums.add(matrix.column[k], 0);
    for (std::size_t k = first; k < sums.columns.size(); ++k) {
      std::int32_t at = prolongation.begin[sums.columns[k]];
      while (prolongation.column[at] != a)
        ++at;
      sums.values[k] = prolongation.value[at];
    }
  });
}

/// A matrix in single precision.
Rows<float> to_single(const Rows<double>& matrix) {
  Rows<float> out;
  out.begin = Array<std::int32_t>(matrix.begin.size());
  out.column = Array<std::int32_t>(matrix.column.size());
  out.value = Array<float>(matrix.value.size());
  for_each_block(matrix.begin.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::copy(&matrix.begin[begin], matrix.begin.begin() + end, &out.begin[begin]);
  });
  for_each_block(matrix.value.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::copy(&matrix.column[begin], matrix.column.begin() + end, &out.column[begin]);
    std::transform(&matrix.value[begin], matrix.value.begin() + end, &out.value[begin],
                   [](double value) { return static_cast<float>(value); });
  });
  return out;
}

/// The rows of a matrix, each scaled with those factors on both sides.
Rows<double> scaled(const SparseMatrix& matrix, const Array<double>& factor) {
  Rows<double> out;
  out.begin = Array<std::int32_t>(matrix.rows() + 1);
  std::copy_n(matrix.outerIndexPtr(), matrix.rows() + 1, out.begin.begin());
  out.column = Array<std::int32_t>(matrix.nonZeros());
  out.value = Array<double>(matrix.nonZeros());
  for_each_block(matrix.rows(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      for (std::int32_t k = out.begin[i]; k != out.begin[i + 1]; ++k) {
        out.column[k] = matrix.innerIndexPtr()[k];
        out.value[k] = matrix.valuePtr()[k] * factor[i] * factor[out.column[k]];
      }
  });
  return out;
}

Eigen::SparseMatrix<double> eigen_matrix(const Rows<double>& matrix) {
  using Map = Eigen::Map<const SparseMatrix>;
  return Map(matrix.size(), matrix.size(), matrix.value.size(), matrix.begin.begin(),
             matrix.column.begin(), matrix.value.begin());
}

// ---- The cycle, in single precision

template <class Vectors>
auto row_times(const Rows<float>& matrix, std::int64_t row, const Vectors& x) {
  auto sum = 0 * x[0];
  for (std::int32_t k = matrix.begin[row]; k != matrix.begin[row + 1]; ++k)
    sum += matrix.value[k] * x[matrix.column[k]];
  return sum;
}

/// Sets out[i] = value(i) for all of its elements.
template <class Vectors, class Value> void set_all(Vectors& out, const Value& value) {
  for_each_block(out.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      out[i] = value(i);
  });
}

} // namespace

Multigrid::Multigrid(SparseMatrix given) : scale_(given.rows()) {
  for_each_block(given.rows(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      scale_[i] = 1 / std::sqrt(given.coeff(i, i));
  });
  Rows<double> matrix = scaled(given, scale_);
  given = {};
  Array<double> constant(matrix.size()); // almost mapped to zero: a constant before the scaling
  for (std::int64_t i = 0; i < constant.size(); ++i)
    constant[i] = 1 / scale_[i];
  const double largest = *std::max_element(constant.begin(), constant.end());
  for (double& value : constant)
    value /= largest;
  while (matrix.size() > coarsest_rows) {
    const Array<double> diagonal = diagonal_of(matrix);
    Array<double> norms = norms_of_aggregates(constant);
    const Rows<double> prolongation = prolongation_of(matrix, diagonal, constant, norms);
    const Rows<double> restriction = transposed(prolongation, matrix, norms.size());
    const std::int64_t n = matrix.size();
    Level level{to_single(matrix),
                to_single(prolongation),
                to_single(restriction),
                Array<float>(n),
                Vectors(n),
                Vectors(n),
                Vectors(n)};
    for (std::int64_t i = 0; i < n; ++i)
      level.step[i] = static_cast<float>(relaxation / diagonal[i]);
    levels_.push_back(std::move(level));
    matrix =
        product(restriction, product(matrix, prolongation, norms.size(), 10), norms.size(), 25);
    constant = std::move(norms);
  }
  coarsest_ = Vectors(matrix.size());
  factors_.compute(eigen_matrix(matrix));
}

Points3 Multigrid::solve(const Points3& right) {
  Vectors& top = levels_.empty() ? coarsest_ : levels_.front().right;
  const std::int64_t n = right.cols();
  std::vector<double> most(static_cast<std::size_t>(block_count(n)), 0);
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      most[static_cast<std::size_t>(block)] = std::max(
          most[static_cast<std::size_t>(block)], scale_[i] * right.col(i).cwiseAbs().maxCoeff());
  });
  // Single precision has few exponents: the largest number becomes about 1.
  const double largest = *std::max_element(most.begin(), most.end());
  if (!(largest > 0))
    return Points3::Zero(3, n);
  set_all(top, [&](std::int64_t i) {
    const Vec3 scaled = scale_[i] / largest * column(right, i);
    return Float4{static_cast<float>(scaled.x), static_cast<float>(scaled.y),
                  static_cast<float>(scaled.z), 0};
  });
  cycle(0);
  const Vectors& solved = levels_.empty() ? coarsest_ : levels_.front().x;
  Points3 solution(3, n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      set_column(solution, i,
                 (scale_[i] * largest) * Vec3{solved[i][0], solved[i][1], solved[i][2]});
  });
  return solution;
}

/// From a level's right side to its x.
void Multigrid::cycle(std::size_t level) {
  if (level == levels_.size())
    return solve_coarsest();
  Level& here = levels_[level];
  const Rows<float>& matrix = here.matrix;
  Vectors &x = here.x, &other = here.other;
  const Vectors& right = here.right;
  const auto relax = [&] {
    set_all(other, [&](std::int64_t i) {
      return x[i] + here.step[i] * (right[i] - row_times(matrix, i, x));
    });
    std::swap(x, other);
  };
  set_all(x, [&](std::int64_t i) { return here.step[i] * right[i]; });
  relax();
  set_all(other, [&](std::int64_t i) { return right[i] - row_times(matrix, i, x); });
  const bool coarsest = level + 1 == levels_.size();
  set_all(coarsest ? coarsest_ : levels_[level + 1].right,
          [&](std::int64_t a) { return row_times(here.restriction, a, other); });
  cycle(level + 1);
  const Vectors& correction = coarsest ? coarsest_ : levels_[level + 1].x;
  set_all(other,
          [&](std::int64_t i) { return x[i] + row_times(here.prolongation, i, correction); });
  std::swap(x, other);
  relax();
  relax();
}

void Multigrid::solve_coarsest() {
  Eigen::MatrixXd right(coarsest_.size(), 3);
  for (Eigen::Index i = 0; i < right.rows(); ++i)
    for (int k = 0; k < 3; ++k)
      right(i, k) = coarsest_[i][k];
  const Eigen::MatrixXd x = factors_.solve(right);
  for (Eigen::Index i = 0; i < right.rows(); ++i)
    coarsest_[i] = Float4{static_cast<float>(x(i, 0)), static_cast<float>(x(i, 1)),
                          static_cast<float>(x(i, 2)), 0};
}

} // namespace calotte::cvt_detail
