// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/multigrid.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/vector_loops.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

namespace calotte::cvt_detail {
namespace {

constexpr std::int64_t coarsest_rows = 300, aggregate_rows = 8;
constexpr float smoothing = 0.9F; ///< of the step of Jacobi's method in the prolongation
constexpr float overlap = 0.3F;   ///< see matrix_of_aggregates()

std::int64_t count_aggregates(std::int64_t rows) {
  return std::max<std::int64_t>(1, rows / aggregate_rows);
}

/// Eight consecutive rows; the last aggregate takes the remainder.
std::int32_t find_aggregate(std::int64_t row, std::int64_t aggregates) {
  return static_cast<std::int32_t>(std::min(row / aggregate_rows, aggregates - 1));
}

/// The end of an aggregate's rows.
std::int64_t aggregate_end(std::int64_t aggregate, std::int64_t aggregates, std::int64_t rows) {
  return aggregate + 1 == aggregates ? rows : aggregate_rows * (aggregate + 1);
}

// ---- Set-up

/// Sorts parts of a row's elements, and adds those of each element in double precision.
void merge(std::vector<Element>& row) {
  std::sort(row.begin(), row.end(), [](const Element& a, const Element& b) {
    return std::pair(a.column, a.value) < std::pair(b.column, b.value);
  });
  std::size_t count = 0;
  for (std::size_t first = 0, last = 0; first != row.size(); first = last) {
    double sum = 0;
    for (; last != row.size() && row[last].column == row[first].column; ++last)
      sum += row[last].value;
    row[count++] = {row[first].column, static_cast<float>(sum)};
  }
  row.resize(count);
}

/// Builds rows with ascending columns from blocks that are computed side by side.
/// \param set_row(i, row) sets the elements of a row, in parts and in any order.
template <class SetRow> Rows make_rows(std::int64_t rows, const SetRow& set_row) {
  Rows out;
  out.begin = Array<std::int32_t>(rows + 1);
  std::vector<std::vector<Element>> parts(static_cast<std::size_t>(block_count(rows)));
  std::vector<std::int32_t> first(parts.size());
  for_each_block(rows, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    std::vector<Element>& part = parts[static_cast<std::size_t>(block)];
    std::vector<Element> row;
    for (std::int64_t i = begin; i != end; ++i) {
      out.begin[i] = static_cast<std::int32_t>(part.size());
      row.clear();
      set_row(i, row);
      merge(row);
      part.insert(part.end(), row.begin(), row.end());
    }
    first[static_cast<std::size_t>(block)] = static_cast<std::int32_t>(part.size());
  });
  const std::int32_t count = out.begin[rows] = exclusive_scan(std::span(first));
  out.items = Array<Element>(count);
  for_each_block(rows, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    const std::vector<Element> part = std::move(parts[static_cast<std::size_t>(block)]);
    const std::int32_t to = first[static_cast<std::size_t>(block)];
    for (std::int64_t i = begin; i != end; ++i)
      out.begin[i] += to;
    std::copy(part.begin(), part.end(), out.items.begin() + to);
  });
  return out;
}

/// Divides the vector that the matrix almost maps to zero by its norm on each aggregate, and
/// replaces it by these norms.
Array<float> normalised(Array<double>& constant) {
  const std::int64_t rows = constant.size(), aggregates = count_aggregates(rows);
  Array<double> norms(aggregates);
  Array<float> out(rows);
  for_each_block(aggregates, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a != end; ++a) {
      const std::int64_t last = aggregate_end(a, aggregates, rows);
      double sum = 0;
      for (std::int64_t i = aggregate_rows * a; i != last; ++i)
        sum += constant[i] * constant[i];
      norms[a] = std::sqrt(sum);
      for (std::int64_t i = aggregate_rows * a; i != last; ++i)
        out[i] = static_cast<float>(constant[i] / norms[a]);
    }
  });
  constant = std::move(norms);
  return out;
}

/// The matrix of the aggregates: its diagonal, and the other elements negated. Smoothed aggregation
/// uses P^T (I - W) P. For vectors that change slowly along the mesh, this is 0.28 to 0.37 times
/// C^T (I - W) C, with C the columns before smoothing. For the norms, which P and C prolong to the
/// same vector, it equals C^T (I - W) C. So this function scales the part of C^T (I - W) C that
/// maps the norms to zero, and keeps the diagonal remainder. That takes a tenth of the product's
/// time and has half of its elements (Braess, Computing 55, 1995, corrects the energy of aggregates
/// by such a factor).
Rows matrix_of_aggregates(const Rows& weights, const Array<float>& constant,
                          const Array<double>& norms, Array<double>& diagonal) {
  const std::int64_t rows = weights.size(), aggregates = norms.size();
  return make_rows(aggregates, [&](std::int64_t a, std::vector<Element>& row) {
    double sum = 0, others = 0;
    for (std::int64_t i = aggregate_rows * a; i != aggregate_end(a, aggregates, rows); ++i) {
      sum += constant[i] * constant[i];
      for (const auto& [j, weight] : weights[i]) {
        const std::int32_t b = find_aggregate(j, aggregates);
        const float value = weight * constant[i] * constant[j];
        if (b == a) {
          sum -= value;
        } else {
          row.push_back({b, overlap * value});
          others += value * norms[b];
        }
      }
    }
    diagonal[a] = sum - (1 - overlap) * others / norms[a];
  });
}

/// Scales the matrix of the aggregates to a diagonal of ones, and the columns of aggregates with
/// it.
void scale(const Array<double>& diagonal, Rows& weights, Array<double>& constant,
           Array<float>& columns) {
  const std::int64_t rows = columns.size(), aggregates = diagonal.size();
  for_each_block(aggregates, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a != end; ++a) {
      const double root = std::sqrt(diagonal[a]);
      constant[a] *= root;
      for (std::int64_t i = aggregate_rows * a; i != aggregate_end(a, aggregates, rows); ++i)
        columns[i] = static_cast<float>(columns[i] / root);
      for (auto& [b, weight] : weights[a])
        weight = static_cast<float>(weight / (root * std::sqrt(diagonal[b])));
    }
  });
}

// ---- The cycle, in single precision. Each function handles the rows from begin to end

/// One sweep forward from zero, and one backward. Elements outside the block do not count. Both
/// sweeps read whole rows: the number of elements before the diagonal varies, so that a loop ending
/// there would be mispredicted.
CALOTTE_VECTOR_WIDTHS void relax_from_zero(const Rows& w, std::int64_t begin, std::int64_t end,
                                           Column right, Float4* x) {
  std::fill(x + begin, x + end, Float4{});
  const auto relax_row = [&](std::int64_t i) {
    Float4 sum = right[i];
    for (const auto [j, weight] : w[i])
      if (j >= begin && j < end) [[likely]]
        sum += weight * x[j];
    x[i] = sum;
  };
  for (std::int64_t i = begin; i != end; ++i)
    relax_row(i);
  for (std::int64_t i = end; i-- != begin;)
    relax_row(i);
}

/// The right side minus the matrix times x.
CALOTTE_VECTOR_WIDTHS void set_residual(const Rows& w, std::int64_t begin, std::int64_t end,
                                        Column right, const Float4* x, Float4* residual) {
  for (std::int64_t i = begin; i != end; ++i) {
    Float4 sum = right[i] - x[i];
    for (const auto [j, weight] : w[i])
      sum += weight * x[j];
    residual[i] = sum;
  }
}

/// One sweep forward and one backward, from x to `to`; elements outside the block are those of x.
CALOTTE_VECTOR_WIDTHS void relax(const Rows& w, std::int64_t begin, std::int64_t end, Column right,
                                 const Float4* x, Float4* to) {
  std::copy(x + begin, x + end, to + begin);
  const auto relax_row = [&](std::int64_t i) {
    Float4 sum = right[i];
    for (const auto [j, weight] : w[i]) {
      const Float4* const from = j >= begin && j < end ? to : x;
      sum += weight * from[j];
    }
    to[i] = sum;
  };
  for (std::int64_t i = begin; i != end; ++i)
    relax_row(i);
  for (std::int64_t i = end; i-- != begin;)
    relax_row(i);
}

/// The residual's smoothed sum over an aggregate: its inner product with the column of the
/// prolongation.
CALOTTE_VECTOR_WIDTHS void restrict_rows(const Rows& w, std::int64_t begin, std::int64_t end,
                                         const float* constant, const Float4* residual,
                                         Float4& total) {
  total = Float4{};
  for (std::int64_t i = begin; i != end; ++i) {
    Float4 sum = {};
    for (const auto [j, weight] : w[i])
      sum += weight * residual[j];
    total += constant[i] * ((1 - smoothing) * residual[i] + smoothing * sum);
  }
}

/// Adds the prolongation of a correction.
CALOTTE_VECTOR_WIDTHS void prolong(const Rows& w, std::int64_t begin, std::int64_t end,
                                   const float* constant, const Float4* correction,
                                   std::int64_t aggregates, Float4* x) {
  for (std::int64_t i = begin; i != end; ++i) {
    Float4 sum = {};
    for (const auto [j, weight] : w[i])
      sum += (weight * constant[j]) * correction[find_aggregate(j, aggregates)];
    x[i] +=
        (1 - smoothing) * constant[i] * correction[find_aggregate(i, aggregates)] + smoothing * sum;
  }
}

} // namespace

Multigrid::Multigrid(Laplacian matrix) : scale_(std::move(matrix.scale)) {
  Rows weights = std::move(matrix.weights);
  Array<double> constant(weights.size()); // almost mapped to zero: a constant before the scaling
  const double smallest = *std::min_element(scale_.begin(), scale_.end());
  for_each_block(weights.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      constant[i] = smallest / scale_[i];
  });
  while (weights.size() > coarsest_rows) {
    const std::int64_t n = weights.size();
    Array<float> columns = normalised(constant);
    Array<double> diagonal(constant.size());
    Rows coarse = matrix_of_aggregates(weights, columns, constant, diagonal);
    scale(diagonal, coarse, constant, columns);
    levels_.push_back(
        {std::move(weights), std::move(columns), Vectors(n), Vectors(n), Vectors(coarse.size())});
    weights = std::move(coarse);
  }
  coarsest_ = Vectors(weights.size());
  std::vector<std::int32_t> columns;
  std::vector<float> values;
  for (const auto& [column, value] : weights.items) {
    columns.push_back(column);
    values.push_back(value);
  }
  factors_ = Cholesky({weights.begin.begin(), weights.begin.end()}, columns, values);
}

void Multigrid::solve(Points3& vectors) {
  const std::int64_t n = vectors.cols();
  std::vector<double> most(static_cast<std::size_t>(block_count(n)), 0);
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    double here = 0;
    for (std::int64_t i = begin; i != end; ++i)
      here = std::max(here, scale_[i] * vectors.col(i).cwiseAbs().maxCoeff());
    most[static_cast<std::size_t>(block)] = here;
  });
  // Scales the largest number to about 1, as single precision has a small range of exponents.
  const double largest = *std::max_element(most.begin(), most.end());
  if (!(largest > 0))
    return void(vectors.setZero());
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3 scaled = scale_[i] / largest * column(vectors, i);
      const Float4 right{static_cast<float>(scaled.x), static_cast<float>(scaled.y),
                         static_cast<float>(scaled.z), 0};
      std::memcpy(&vectors(0, i), &right, sizeof right);
    }
  });
  const Vectors& x = solve(0, {vectors.data(), 3});
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      set_column(vectors, i, (scale_[i] * largest) * Vec3{x[i][0], x[i][1], x[i][2]});
  });
}

/// One cycle, from a level to the coarsest and back.
const Multigrid::Vectors& Multigrid::solve(std::size_t level, Column right) {
  if (level == levels_.size())
    return solve_coarsest(right);
  Level& here = levels_[level];
  const Rows& w = here.weights;
  const std::int64_t n = w.size();
  Float4 *x = here.x.begin(), *other = here.other.begin();
  const auto pass = [n](const auto& body) {
    for_each_block(n,
                   [&](std::int64_t, std::int64_t begin, std::int64_t end) { body(begin, end); });
  };
  pass([&](auto begin, auto end) { relax_from_zero(w, begin, end, right, x); });
  pass([&](auto begin, auto end) { set_residual(w, begin, end, right, x, other); });
  restrict_residual(here);
  const Vectors& correction = solve(level + 1, {here.coarse_right.begin(), 2});
  pass([&](auto begin, auto end) {
    prolong(w, begin, end, here.constant.begin(), correction.begin(), correction.size(), x);
  });
  pass([&](auto begin, auto end) { relax(w, begin, end, right, x, other); });
  std::swap(here.x, here.other);
  return here.x;
}

void Multigrid::restrict_residual(Level& level) {
  Vectors& right = level.coarse_right;
  const std::int64_t rows = level.weights.size(), count = right.size();
  for_each_block(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a != end; ++a)
      restrict_rows(level.weights, aggregate_rows * a, aggregate_end(a, count, rows),
                    level.constant.begin(), level.other.begin(), right[a]);
  });
}

const Multigrid::Vectors& Multigrid::solve_coarsest(Column right_side) {
  const std::int64_t n = coarsest_.size();
  Array<double> columns(3 * n);
  for (std::int64_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k)
      columns[k * n + i] = right_side[i][k];
  factors_.solve({columns.begin(), columns.end()});
  for (std::int64_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k)
      coarsest_[i][k] = static_cast<float>(columns[k * n + i]);
  return coarsest_;
}

} // namespace calotte::cvt_detail
