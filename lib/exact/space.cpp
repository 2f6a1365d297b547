// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/space.h"

#include "base/first_fault.h"
#include "base/parallel.h"
#include "base/points.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace calotte::exact_detail {
namespace {

/// Adds the smaller two first: the sum is the same for any order of the coordinates.
double symmetric_sum(double a, double b, double c) {
  const double largest = std::max({a, b, c});
  if (largest == a)
    return (b + c) + a;
  return largest == b ? (a + c) + b : (a + b) + c;
}

/// The direction of a vector whose square neither overflows nor underflows.
Vec3 unit(const Vec3& a) {
  const double length = std::sqrt(symmetric_sum(a.x * a.x, a.y * a.y, a.z * a.z));
  return {a.x / length, a.y / length, a.z / length};
}

double size_of(const Vec2& v) { return std::max(std::abs(v.x), std::abs(v.y)); }

/// Whether copies are at most one period from each other, where a product with the number of
/// periods is exact.
bool adjacent(const Image& a, const Image& b) {
  return std::abs(a.i - b.i) <= 1 && std::abs(a.j - b.j) <= 1;
}

} // namespace

Vec3 unit_of_any_norm(const Vec3& a) {
  const double largest = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  if (largest > 0x1p-400 && largest < 0x1p400)
    return unit(a);
  const double scale = largest < 1 ? 0x1p600 : 0x1p-600;
  return unit(scale * a);
}

Vec3 Sphere::midpoint(const Vec3& a, const Vec3& b) {
  return unit(unit_of_any_norm(a) + unit_of_any_norm(b));
}

double Plane::middle(double a, double b, double period) {
  const double middle = a / 2 + b / 2;
  if (!(period > 0) || std::abs(a - b) <= period / 2)
    return middle;
  const double across = middle < period / 2 ? middle + period / 2 : middle - period / 2;
  return across < period ? across : 0;
}

Vec2 Plane::way(const Position& from, const Position& to) const {
  return {to.site.x - from.site.x + (to.i - from.i) * period_.x,
          to.site.y - from.site.y + (to.j - from.j) * period_.y};
}

/// In a box the offsets from a corner err by up to e = 2u L each, u the roundoff and L the longer
/// period: a difference of points in the box and the sum of that and a period are rounded, each to
/// u L at most, as is a product with -1, 0 or 1 times the period not at all. With offsets up to D,
/// the products' and their difference's rounding adds 4u D^2: in all below 4 D e + 2 e^2 + 4u D^2.
/// The bound is twice that, which also covers a point outside the box, next to which the copies
/// are.
int Plane::orientation(const Position& a, const Position& b, const Position& c) const {
  if (is_box() && adjacent(a, b) && adjacent(a, c)) {
    const Vec2 p = way(a, b), q = way(a, c);
    const double value = p.x * q.y - p.y * q.x, e = 2 * roundoff * size_of(period_),
                 d = std::max(size_of(p), size_of(q)), error = 8 * d * e + 8 * roundoff * d * d;
    if (std::abs(value) > error)
      return value > 0 ? 1 : -1;
  }
  return exact_detail::orientation(period_, a, b, c);
}

/// With offsets from d as above, the determinant is a sum of 12 products of four of them: it errs
/// by up to 48 D^3 e, and by 12 * 10u D^4 of its own rounding.
int Plane::in_circle(const Position& a, const Position& b, const Position& c,
                     const Position& d) const {
  if (is_box() && adjacent(d, a) && adjacent(d, b) && adjacent(d, c)) {
    const Vec2 p = way(d, a), q = way(d, b), r = way(d, c);
    const auto square = [](const Vec2& x) { return x.x * x.x + x.y * x.y; };
    const double value = square(p) * (q.x * r.y - q.y * r.x) - square(q) * (p.x * r.y - p.y * r.x) +
                         square(r) * (p.x * q.y - p.y * q.x);
    const double e = 4 * roundoff * size_of(period_),
                 most = std::max({size_of(p), size_of(q), size_of(r)});
    const double error = (64 * e + 160 * roundoff * most) * most * most * most;
    if (std::abs(value) > error)
      return value > 0 ? 1 : -1;
  }
  return exact_detail::in_circle(period_, a, b, c, d);
}

/// The offsets p and q err by up to e = 4u M each, M the largest coordinate: their scalar product
/// by less than 2 (|p| + |q|) e.
bool Plane::is_clearly_acute(const Position& a, const Position& b, const Position& c) const {
  const Vec2 p = way(a, b), q = way(a, c);
  const double largest = size_of(a.site) + size_of(p) + size_of(q) + size_of(period_);
  return p.x * q.x + p.y * q.y > 16 * roundoff * largest * (size_of(p) + size_of(q));
}

bool Plane::is_short(const Position& a, const Position& b) const {
  const Vec2 along = way(a, b);
  const auto is_short = [](double length, double period) {
    return !(period > 0) || 1.000001 * std::abs(length) < period / 2;
  };
  return is_short(along.x, period_.x) && is_short(along.y, period_.y);
}

void require_positions(const Plane& plane, const PointsRef& points, const std::string& thing) {
  FirstFault infinite, fault;
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3 x = point(points, i);
      if (!std::isfinite(x.x) || !std::isfinite(x.y))
        infinite.at(i);
      else if (!plane.has_position(x))
        fault.at(i);
    }
  });
  infinite.refuse(thing, "is not finite; give finite coordinates");
  fault.refuse(thing, "is more than 2^30 periods away; give its copy in the box");
}

} // namespace calotte::exact_detail
