// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/elementary.h"
#include "base/points.h"
#include "base/vec3.h"
#include "voronoi/room.h"

#include <cmath>
#include <cstdint>
#include <numbers>

/// The measures that geometry.cpp computes in vector code, on the unit sphere and in a periodic
/// plane.
///
/// Operations per lane have no branches, so that the loops over lanes become vector code.
namespace calotte::voronoi_detail::dual {

// ---- Elementary functions

inline constexpr double pi = std::numbers::pi;

/// The angle of a vector (x, y) of any norm from the first axis, -pi to pi; 0 for the zero vector.
CALOTTE_INLINE double angle_of(double x, double y) {
  const double across = std::abs(y), along = std::abs(x);
  const bool steep = across > along;
  const double larger = steep ? across : along, smaller = steep ? along : across;
  const double acute = arc_tangent(larger > 0 ? smaller / larger : 0);
  const double above = steep ? pi / 2 - acute : acute;
  return std::copysign(x < 0 ? pi - above : above, y);
}

CALOTTE_INLINE double square(const Vec3& a) { return dot(a, a); }

CALOTTE_INLINE Vec3 choose(bool first, const Vec3& a, const Vec3& b) {
  return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

/// The direction of a vector of moderate norm; for a zero vector, a given direction.
CALOTTE_INLINE Vec3 direction_or(const Vec3& a, const Vec3& other) {
  const double s = square(a);
  const bool some = s > 1e-300;
  return choose(some, (1 / std::sqrt(some ? s : 1)) * a, other);
}

// ---- Measures on the sphere and in a periodic plane

/// A half kite at an edge of a triangle. Those at the edge's two ends are mirror images.
struct HalfKite {
  double arc;  ///< signed, from the edge's middle to the circumcentre
  double area; ///< signed, of one half kite
};

/// The unit sphere; points are unit vectors.
struct SphereMeasures {
  const Array<double>& surplus; ///< by cell: its norm minus 1

  /// The difference of two cells as if both were exactly on the sphere: for a short edge, the
  /// rounding of norms would be large.
  Vec3 difference(const Points3& cells, std::int32_t from, std::int32_t to) const {
    const Vec3 &a = column(cells, from), &b = column(cells, to);
    return (b - a) + (surplus[from] * a - surplus[to] * b);
  }

  /// \param normal (b - a) x (c - a) of a triangle; zero of a thin one.
  /// \param middle the flat triangle's circumcentre, from a.
  CALOTTE_INLINE Vec3 circumcentre(const Vec3& normal, const Vec3& a, const Vec3& middle) const {
    // The flat centre keeps the digits of small triangles; the normal keeps those of large ones,
    // whose flat centre is near the sphere's.
    const double outward = dot(normal, a);
    const bool flat = square(middle) < 0.25 || outward == 0;
    return direction_or(choose(flat, a + middle, std::copysign(1.0, outward) * normal), a);
  }
  /// Rounding can reverse a triangle whose corners are equal up to rounding.
  CALOTTE_INLINE double height(const Vec3& normal, const Vec3& a) const {
    return 2 * std::abs(dot(normal, a));
  }
  CALOTTE_INLINE HalfKite half_kite(const Vec3& a, const Vec3& difference, double product,
                                    double height) const {
    const double length = std::sqrt(square(difference));
    const double sum = std::sqrt(square((a + a) + difference));
    const double sine = length * product, hypotenuse = std::sqrt(sine * sine + height * height);
    const double divisor = hypotenuse + height;
    const double tangent = sine / (divisor > 0 ? divisor : 1);
    return {2 * arc_tangent(tangent), 2 * arc_tangent(length / (2 + sum) * tangent)};
  }
  CALOTTE_INLINE Vec3 midpoint(const Vec3& a, const Vec3& difference, const Vec3& centre) const {
    return direction_or((a + a) + difference, centre);
  }
  CALOTTE_INLINE double distance(const Vec3& a, const Vec3& difference) const {
    return 4 * arc_tangent(std::sqrt(square(difference)) /
                           (2 + std::sqrt(square((a + a) + difference))));
  }
  /// The angle from east, (-y, x, 0) over r = sqrt(x^2 + y^2), to north, (-x z, -y z, r^2) over r.
  CALOTTE_INLINE double angle(const Vec3& m, const Vec3& normal) const {
    const bool pole = m.x == 0 && m.y == 0;
    const double x = pole ? 1 : m.x, y = m.y;
    const double rise = pole ? 0 : normal.z;
    return angle_of(x * normal.y - y * normal.x,
                    rise * (x * x + y * y) - m.z * (x * normal.x + y * normal.y));
  }
};

/// A plane with periods, of which 0 is none; points are in its box.
struct PlaneMeasures {
  double width, depth;

  static CALOTTE_INLINE double nearest(double difference, double period) {
    const double turns = std::floor(difference / (period > 0 ? period : 1) + 0.5);
    return difference - period * turns;
  }
  static CALOTTE_INLINE double wrapped(double x, double period) {
    const double inside = x - period * std::floor(x / (period > 0 ? period : 1));
    return period == 0 || inside < period ? inside : 0; // rounding can reach it
  }
  CALOTTE_INLINE Vec3 wrapped_point(const Vec3& p) const {
    return {wrapped(p.x, width), wrapped(p.y, depth), 0};
  }

  Vec3 difference(const Points3& cells, std::int32_t from, std::int32_t to) const {
    const Vec3 &a = column(cells, from), &b = column(cells, to);
    return {nearest(b.x - a.x, width), nearest(b.y - a.y, depth), 0};
  }
  CALOTTE_INLINE Vec3 circumcentre(const Vec3&, const Vec3& a, const Vec3& middle) const {
    return wrapped_point(a + middle);
  }
  CALOTTE_INLINE double height(const Vec3& normal, const Vec3&) const {
    return 2 * std::abs(normal.z);
  }
  CALOTTE_INLINE HalfKite half_kite(const Vec3&, const Vec3& difference, double product,
                                    double height) const {
    const double length = std::sqrt(square(difference));
    const double arc = length * product / (height > 0 ? height : 1);
    return {arc, 0.25 * length * arc};
  }
  CALOTTE_INLINE Vec3 midpoint(const Vec3& a, const Vec3& difference, const Vec3&) const {
    return wrapped_point(a + 0.5 * difference);
  }
  CALOTTE_INLINE double distance(const Vec3&, const Vec3& difference) const {
    return std::sqrt(square(difference));
  }
  CALOTTE_INLINE double angle(const Vec3&, const Vec3& normal) const {
    const double signed_angle = angle_of(normal.x, normal.y);
    const double turned = signed_angle < 0 ? signed_angle + 2 * pi : signed_angle;
    return turned < 2 * pi ? turned : 0;
  }
};

} // namespace calotte::voronoi_detail::dual
