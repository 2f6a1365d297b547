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

/// A matrix with the columns value(i).
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

/// The start of a part's coordinates, and their number.
const double* start(const Points3& field, Part part) { return field.data() + 3 * part.begin; }
double* start(Points3& field, Part part) { return field.data() + 3 * part.begin; }
const float* start(const CompactField& field, Part part) {
  return field.values.data() + 3 * part.begin;
}
float* start(CompactField& field, Part part) { return field.values.data() + 3 * part.begin; }
std::int64_t length(Part part) { return 3 * part.size(); }

} // namespace

double inner(const Points3& a, const Points3& b) {
  return sums_over_blocks(
      a.cols(), 1, [&](Part part, std::span<double> sums) { sums[0] = inner(a, b, part); })[0];
}

double inner(const Points3& a, const Points3& b, Part part) {
  return inner_of(start(a, part), start(b, part), length(part));
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

void prepare(CompactField& field, double scale, std::int64_t n) {
  field.scale = scale > 0 ? scale : 1;
  if (field.values.cols() != n)
    field.values.resize(3, n);
}

void set_difference(const Points3& a, const Points3& b, CompactField& field, Part part) {
  set_difference_of(start(field, part), 1 / field.scale, start(a, part), start(b, part),
                    length(part));
}

double inner(const CompactField& a, const CompactField& b, Part part) {
  return a.scale * b.scale * inner_of(start(a, part), start(b, part), length(part));
}

std::vector<double> inner_of_each(std::span<const CompactField> fields, const Points3& b) {
  return sums_over_blocks(b.cols(), fields.size(), [&](Part part, std::span<double> sums) {
    inner_of_each(fields, b, part, sums);
  });
}

void inner_of_each(std::span<const CompactField> fields, const Points3& b, Part part,
                   std::span<double> products) {
  for (std::size_t k = 0; k < fields.size(); ++k)
    products[k] = fields[k].scale * inner_of(start(fields[k], part), start(b, part), length(part));
}

void inner_of_each(std::span<const CompactField> fields, const CompactField& b, Part part,
                   std::span<double> products) {
  for (std::size_t k = 0; k < fields.size(); ++k)
    products[k] = inner(fields[k], b, part);
}

void set_sum(Points3& y, double factor, const Points3& x, std::span<const double> shares,
             std::span<const CompactField> fields, Part part) {
  set_multiple(start(y, part), factor, start(x, part), length(part));
  for (std::size_t k = 0; k < fields.size(); ++k)
    add_to(start(y, part), shares[k] * fields[k].scale, start(fields[k], part), length(part));
}

double square_over(const CompactField& a, const Array<double>& weights) {
  return a.scale * a.scale *
         sums_over_blocks(a.values.cols(), 1, [&](Part part, std::span<double> sums) {
           sums[0] = 0;
           for (std::int64_t i = part.begin; i != part.end; ++i)
             sums[0] += a.values.col(i).cast<double>().squaredNorm() / std::abs(weights[i]);
         })[0];
}

void multiply(Points3& y, double a) {
  set_columns(y, [&](std::int64_t i) { return a * column(y, i); });
}

void make_tangential(Points3& vectors, const Points3& x, Part part) {
  for (std::int64_t i = part.begin; i != part.end; ++i) {
    const Vec3 &v = column(vectors, i), &at = column(x, i);
    set_column(vectors, i, v - dot(v, at) * at);
  }
}

Points3 retract(const Points3& x, double step, const Points3& d) {
  Points3 to;
  retract(x, step, d, to);
  return to;
}

void retract(const Points3& x, double step, const Points3& d, Points3& to) {
  if (to.cols() != x.cols())
    to.resize(3, x.cols());
  set_columns(to, [&](std::int64_t i) {
    const Vec3 moved = column(x, i) + step * column(d, i);
    return (1 / norm(moved)) * moved;
  });
}

} // namespace calotte::base_detail
