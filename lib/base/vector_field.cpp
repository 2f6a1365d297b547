// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/vector_field.h"

#include "base/parallel.h"
#include "base/points.h"

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

} // namespace

double inner(const Points3& a, const Points3& b) {
  std::vector<double> sums(static_cast<std::size_t>(block_count(a.cols())), 0);
  for_each_block(a.cols(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Vec3 sum{0, 0, 0}; // three chains of additions, which overlap
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3 &p = column(a, i), &q = column(b, i);
      sum = sum + Vec3{p.x * q.x, p.y * q.y, p.z * q.z};
    }
    sums[static_cast<std::size_t>(block)] = sum.x + sum.y + sum.z;
  });
  double total = 0;
  for (const double sum : sums)
    total += sum;
  return total;
}

void add(Points3& y, double a, const Points3& x) {
  set_columns(y, [&](std::int64_t i) { return column(y, i) + a * column(x, i); });
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
