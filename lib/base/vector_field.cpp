// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/vector_field.h"

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
template <class A>
CALOTTE_INLINE double sum_of_products(const A* a, const double* b, std::int64_t n) {
  constexpr int lanes = 8;
  double sums[lanes] = {};
  std::int64_t i = 0;
  for (; i + lanes <= n; i += lanes)
    for (int k = 0; k < lanes; ++k)
      sums[k] += static_cast<double>(a[i + k]) * b[i + k];
  for (int k = 0; i < n; ++i, ++k)
    sums[k] += static_cast<double>(a[i]) * b[i];
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

CALOTTE_VECTOR_WIDTHS void add_to(double* y, double a, const float* x, std::int64_t n) {
  CALOTTE_VECTOR_LOOP
  for (std::int64_t i = 0; i < n; ++i)
    y[i] += a * static_cast<double>(x[i]);
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

Points3 expanded(const CompactField& field) {
  Points3 vectors = Points3::Zero(3, field.values.cols());
  add(vectors, 1, field);
  return vectors;
}

double inner(const CompactField& a, const Points3& b) {
  return a.scale * sum_blocks(b.cols(), [&](std::int64_t begin, std::int64_t end) {
           return inner_of(a.values.data() + begin, b.data() + begin, end - begin);
         });
}

void add(Points3& y, double a, const CompactField& x) {
  for_each_block(y.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    add_to(y.data() + 3 * begin, a * x.scale, x.values.data() + 3 * begin, 3 * (end - begin));
  });
}

double inner_of_sum(Points3& y, double a, const CompactField& x, const CompactField& b) {
  return b.scale * sum_blocks(y.cols(), [&](std::int64_t begin, std::int64_t end) {
           add_to(y.data() + begin, a * x.scale, x.values.data() + begin, end - begin);
           return inner_of(b.values.data() + begin, y.data() + begin, end - begin);
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
  return make_columns(x.cols(), [&](std::int64_t i) {
    const Vec3 moved = column(x, i) + step * column(d, i);
    return (1 / norm(moved)) * moved;
  });
}

Points3 difference(const Points3& a, const Points3& b) {
  return make_columns(a.cols(), [&](std::int64_t i) { return column(a, i) - column(b, i); });
}

} // namespace calotte::base_detail
