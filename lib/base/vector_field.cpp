// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/vector_field.h"

#include "base/matrix_memory.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/vector_loops.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace calotte::base_detail {
namespace {

/// value(i) for each column.
template <class Value> Points3 make_columns(Eigen::Index n, const Value& value) {
  Points3 result(3, n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      set_column(result, i, value(i));
  });
  return result;
}

template <class Value> void set_columns(Points3& points, const Value& value) {
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      set_column(points, i, value(i));
  });
}

/// The sum of a_i b_i in eight partial sums: the same bits for any vector width.
template <class A, class B>
CALOTTE_INLINE double sum_of_products(const A* a, const B* b, std::int64_t n) {
  constexpr int lanes = 8;
  double sums[lanes] = {};
  std::int64_t i = 0;
  for (; i + lanes <= n; i += lanes)
    for (int k = 0; k < lanes; ++k)
      sums[k] += static_cast<double>(a[i + k]) * static_cast<double>(b[i + k]);
  for (int k = 0; i < n; ++i, ++k)
    sums[k] += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  double total = 0;
  for (const double sum : sums)
    total += sum;
  return total;
}

CALOTTE_VECTOR_WIDTHS double inner_of(const double* a, const double* b, std::int64_t n) {
  return sum_of_products(a, b, n);
}

CALOTTE_VECTOR_WIDTHS double inner_of(const float* a, const double* b, std::int64_t n) {
  return sum_of_products(a, b, n);
}

CALOTTE_VECTOR_WIDTHS double inner_of(const float* a, const float* b, std::int64_t n) {
  return sum_of_products(a, b, n);
}

CALOTTE_VECTOR_WIDTHS void set_multiple(double* y, double a, const double* x, std::int64_t n) {
  CALOTTE_VECTOR_LOOP
  for (std::int64_t i = 0; i < n; ++i)
    y[i] = a * x[i];
}

CALOTTE_VECTOR_WIDTHS void add_to(double* y, double a, const float* x, std::int64_t n) {
  CALOTTE_VECTOR_LOOP
  for (std::int64_t i = 0; i < n; ++i)
    y[i] += a * static_cast<double>(x[i]);
}

CALOTTE_VECTOR_WIDTHS void set_difference_of(float* y, double factor, const double* a,
                                             const double* b, std::int64_t n) {
  CALOTTE_VECTOR_LOOP
  for (std::int64_t i = 0; i < n; ++i)
    y[i] = static_cast<float>(factor * (a[i] - b[i]));
}

/// Sums sum(begin, end), over the coordinates of blocks.
template <class Sum> double sum_blocks(std::int64_t columns, const Sum& sum) {
  std::vector<double> sums(static_cast<std::size_t>(block_count(columns)), 0);
  for_each_block(columns, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    sums[static_cast<std::size_t>(block)] = sum(3 * begin, 3 * end);
  });
  double total = 0;
  for (const double part : sums)
    total += part;
  return total;
}

/// Each block of b is read from the cache by all fields but the first.
template <class Vectors>
std::vector<double> inner_of_all(std::span<const CompactField> fields, const Vectors& b) {
  const std::size_t count = fields.size();
  std::vector<double> sums(count * static_cast<std::size_t>(block_count(b.cols())));
  for_each_block(b.cols(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (std::size_t k = 0; k < count; ++k)
      sums[static_cast<std::size_t>(block) * count + k] =
          inner_of(fields[k].values.data() + 3 * begin, b.data() + 3 * begin, 3 * (end - begin));
  });
  std::vector<double> totals(count, 0);
  for (std::size_t i = 0; i < sums.size(); ++i)
    totals[i % count] += sums[i];
  for (std::size_t k = 0; k < count; ++k)
    totals[k] *= fields[k].scale;
  return totals;
}

} // namespace

double inner(const Points3& a, const Points3& b) {
  return sum_blocks(a.cols(), [&](std::int64_t begin, std::int64_t end) {
    return inner_of(a.data() + begin, b.data() + begin, end - begin);
  });
}

CompactField compacted(const Points3& vectors, double square) {
  const auto n = static_cast<double>(std::max<Eigen::Index>(vectors.cols(), 1));
  CompactField field;
  field.scale = std::sqrt(square / n);
  const double inverse = field.scale > 0 ? 1 / field.scale : 0;
  field.values.resize(3, vectors.cols());
  for_each_block(vectors.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = 3 * begin; i != 3 * end; ++i)
      field.values.data()[i] = static_cast<float>(inverse * vectors.data()[i]);
  });
  return field;
}

Points3 expanded(const CompactField& field) { return field.scale * field.values.cast<double>(); }

double set_difference(const Points3& a, const Points3& b, double scale, CompactField& field) {
  field.scale = scale > 0 ? scale : 1;
  if (field.values.cols() != a.cols())
    make_room(field.values, 3, a.cols());
  const double factor = 1 / field.scale;
  float* const values = field.values.data();
  return field.scale * field.scale *
         sum_blocks(a.cols(), [&](std::int64_t begin, std::int64_t end) {
           set_difference_of(values + begin, factor, a.data() + begin, b.data() + begin,
                             end - begin);
           return inner_of(values + begin, values + begin, end - begin);
         });
}

double inner(const CompactField& a, const CompactField& b) {
  return inner_of_each(std::span(&a, 1), b).front();
}

std::vector<double> inner_of_each(std::span<const CompactField> fields, const Points3& b) {
  return inner_of_all(fields, b);
}

std::vector<double> inner_of_each(std::span<const CompactField> fields, const CompactField& b) {
  std::vector<double> products = inner_of_all(fields, b.values);
  for (double& product : products)
    product *= b.scale;
  return products;
}

void set_sum(Points3& y, double factor, const Points3& x, std::span<const double> shares,
             std::span<const CompactField> fields) {
  for_each_block(y.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    double* const to = y.data() + 3 * begin;
    const std::int64_t n = 3 * (end - begin);
    set_multiple(to, factor, x.data() + 3 * begin, n);
    for (std::size_t k = 0; k < fields.size(); ++k)
      add_to(to, shares[k] * fields[k].scale, fields[k].values.data() + 3 * begin, n);
  });
}

double square_over(const CompactField& a, const Array<double>& weights) {
  return a.scale * a.scale * sum_blocks(a.values.cols(), [&](std::int64_t begin, std::int64_t end) {
           double sum = 0;
           for (std::int64_t i = begin / 3; i != end / 3; ++i)
             sum += a.values.col(i).cast<double>().squaredNorm() / std::abs(weights[i]);
           return sum;
         });
}

void multiply(Points3& y, double a) {
  set_columns(y, [&](std::int64_t i) { return a * column(y, i); });
}

void make_tangential(Points3& vectors, const Points3& x) {
  set_columns(vectors, [&](std::int64_t i) {
    const Vec3 &v = column(vectors, i), &at = column(x, i);
    return v - dot(v, at) * at;
  });
}

Points3 retract(const Points3& x, double step, const Points3& d) {
  Points3 to;
  retract(x, step, d, to);
  return to;
}

void retract(const Points3& x, double step, const Points3& d, Points3& to) {
  if (to.cols() != x.cols())
    make_room(to, 3, x.cols());
  set_columns(to, [&](std::int64_t i) {
    const Vec3 moved = column(x, i) + step * column(d, i);
    return (1 / norm(moved)) * moved;
  });
}

Points3 difference(const Points3& a, const Points3& b) {
  return make_columns(a.cols(), [&](std::int64_t i) { return column(a, i) - column(b, i); });
}

} // namespace calotte::base_detail
