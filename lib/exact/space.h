// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/spherical_triangle.h"
#include "base/vec3.h"
#include "exact/plane_predicates.h"
#include "exact/predicates.h"
#include "exact/room.h"

#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cmath>
#include <concepts>
#include <string>

/// Where points live, for code that is written once: the sphere, or a plane that may be periodic.
/// A function of a Surface calls in_space_of() once, and what is below it takes a Space.
///
///     in_space_of(mesh.surface, [&](const Space auto& space) { ... });
namespace calotte::exact_detail {

/// The unit sphere. Signs take directions of any norm, measures take unit vectors.
class Sphere {
public:
  using Position = Vec3;
  static constexpr bool on_sphere = true;
  static constexpr int copies = 1;

  // ---- Positions

  static bool has_position(const Vec3&) { return true; }
  static Position position(const Vec3& x) { return x; }
  static Position copy(const Position& p, int) { return p; }
  static Position near(const Vec3& x, const Position&) { return x; }
  static Vec3 coordinates(const Position& p) { return normalised(p); }
  static Vec3 seen(const Position& p, const Position&) { return normalised(p); }

  // ---- Exact signs

  static int orientation(const Position& a, const Position& b, const Position& c) {
    return exact_detail::orientation(a, b, c);
  }
  static int in_circle(const Position& a, const Position& b, const Position& c, const Position& d) {
    return exact_detail::in_circle(a, b, c, d);
  }
  static int in_circle_resolved(const Position& a, const Position& b, const Position& c,
                                const Position& d) {
    return exact_detail::in_circle_resolved(View{}, a, b, c, d);
  }
  static int compare_distances(const Position& p, const Position& a, const Position& b) {
    return exact_detail::compare_distances(p, a, b);
  }
  /// Rounding is below 1e-14 for unit vectors.
  static bool is_clearly_acute(const Position& a, const Position& b, const Position& c) {
    return dot(b - a, c - a) > 1e-14;
  }
  static bool is_short(const Position&, const Position&) { return true; }

  // ---- Measures

  static Vec3 wrapped(const Vec3& x) { return x; }
  static Vec3 up(const Vec3& x) { return x; }
  static Vec3 offset(const Vec3& a, const Vec3& b) { return b - a; }
  /// The midpoint of the shorter arc; a unit vector.
  static Vec3 midpoint(const Vec3& a, const Vec3& b);
  static double area_term(const Vec3& a, const Vec3& b, const Vec3& c) {
    return dot(a, cross(b - a, c - a));
  }
  static double area(const Vec3& a, const Vec3& b, const Vec3& c) { return triangle_area(a, b, c); }
  static Vec3 circumcentre(const Vec3& a, const Vec3& b, const Vec3& c) {
    return normalised(cross(b - a, c - a));
  }
};

/// The circumcentre of 0, u and v.
inline Vec2 circumcentre(const Vec2& u, const Vec2& v) {
  const double u2 = u.x * u.x + u.y * u.y, v2 = v.x * v.x + v.y * v.y,
               four_areas = 2 * (u.x * v.y - u.y * v.x);
  return {(v.y * u2 - u.y * v2) / four_areas, (u.x * v2 - v.x * u2) / four_areas};
}

/// The plane, or a plane that is periodic in one direction or in both. Points have z = 0.
class Plane {
public:
  using Position = Image;
  static constexpr bool on_sphere = false;
  static constexpr int copies = 9;

  Plane() = default; ///< without a period
  /// \param period 0 in a direction without one.
  explicit Plane(const Vec2& period) : period_(period) {}
  explicit Plane(const Eigen::Vector2d& period) : period_{period.x(), period.y()} {}

  const Vec2& period() const { return period_; }

  // ---- Positions: copies of points

  bool has_position(const Vec3& x) const {
    return within_reach(x.x, period_.x) && within_reach(x.y, period_.y);
  }
  Position position(const Vec3& x) const {
    return {{x.x, x.y}, boxes(x.x, period_.x), boxes(x.y, period_.y)};
  }
  Position copy(const Position& p, int k) const {
    const int i = k % 3 - 1, j = k / 3 - 1;
    return {p.site, p.i + (period_.x > 0 ? i : 0), p.j + (period_.y > 0 ? j : 0)};
  }
  /// The nearest copy. Of two that are equally near, see periods_between().
  Position near(const Vec3& x, const Position& p) const {
    return {{x.x, x.y},
            static_cast<int>(p.i + periods_between(p.site.x, x.x, period_.x)),
            static_cast<int>(p.j + periods_between(p.site.y, x.y, period_.y))};
  }
  Vec3 coordinates(const Position& p) const {
    return {p.site.x + p.i * period_.x, p.site.y + p.j * period_.y, 0};
  }
  Vec3 seen(const Position& x, const Position& p) const { return coordinates(x) - coordinates(p); }

  // ---- Exact signs

  int orientation(const Position& a, const Position& b, const Position& c) const;
  int in_circle(const Position& a, const Position& b, const Position& c, const Position& d) const;
  int in_circle_resolved(const Position& a, const Position& b, const Position& c,
                         const Position& d) const {
    const int sign = in_circle(a, b, c, d);
    return sign != 0 ? sign : in_circle_tie(period_, a, b, c, d);
  }
  int compare_distances(const Position& p, const Position& a, const Position& b) const {
    return exact_detail::compare_distances(period_, p, a, b);
  }
  bool is_clearly_acute(const Position& a, const Position& b, const Position& c) const;
  bool is_short(const Position& a, const Position& b) const;

  // ---- Measures

  /// The copy whose coordinates are in [0, period); bits that are there stay.
  Vec3 wrapped(const Vec3& x) const {
    return {wrapped(x.x, period_.x), wrapped(x.y, period_.y), x.z};
  }
  static Vec3 up(const Vec3&) { return {0, 0, 1}; }
  /// The offset from a to the copy of b nearest to a. offset(b, a) is the opposite.
  Vec3 offset(const Vec3& a, const Vec3& b) const {
    return {b.x - a.x + periods_between(a.x, b.x, period_.x) * period_.x,
            b.y - a.y + periods_between(a.y, b.y, period_.y) * period_.y, 0};
  }
  /// The midpoint of the shortest path between points in the box; in the box.
  Vec3 midpoint(const Vec3& a, const Vec3& b) const {
    return {middle(a.x, b.x, period_.x), middle(a.y, b.y, period_.y), 0};
  }
  static double area_term(const Vec3& a, const Vec3& b, const Vec3& c) {
    return cross(b - a, c - a).z;
  }
  double area(const Vec3& a, const Vec3& b, const Vec3& c) const {
    return cross(offset(a, b), offset(a, c)).z / 2;
  }
  Vec3 circumcentre(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec3 u = offset(a, b), v = offset(a, c);
    const Vec2 centre = exact_detail::circumcentre({u.x, u.y}, {v.x, v.y});
    return wrapped(Vec3{a.x + centre.x, a.y + centre.y, 0});
  }

private:
  /// The shift of the copy of b nearest to a, in whole periods; 0 if there is no period. Of two
  /// that are equally near, it is the one on the other side of a: b's own copy half a period away
  /// is not chosen, and the shift of the copy of a nearest to b is the opposite.
  static double periods_between(double a, double b, double period) {
    return period > 0 ? -std::round((b - a) / period) : 0;
  }
  static double wrapped(double x, double period) {
    if (!(period > 0))
      return x;
    const double inside = x - std::floor(x / period) * period;
    return inside >= 0 && inside < period ? inside : 0;
  }
  static double middle(double a, double b, double period);
  static bool within_reach(double x, double period) {
    constexpr double most_periods = 1 << 30; // so that the number of a copy is an int
    return !(period > 0) || std::abs(x) <= most_periods * period;
  }
  static int boxes(double x, double period) {
    return period > 0 ? -static_cast<int>(std::floor(x / period)) : 0;
  }
  bool is_box() const { return period_.x > 0 && period_.y > 0; } ///< periodic in both directions
  Vec2 way(const Position& from, const Position& to) const;

  Vec2 period_{0, 0};
};

/// The operations of Sphere and Plane. An exact sign takes positions, which are points on the
/// sphere and copies of points in a plane; a measure takes points.
template <class S>
concept Space = requires(const S space, const Vec3& x, const typename S::Position& p, int k) {
  { S::on_sphere } -> std::convertible_to<bool>;
  { S::copies } -> std::convertible_to<int>; ///< of a point within one period around it
  /// Whether a point has positions: in a periodic direction it is at most 2^30 periods from 0.
  { space.has_position(x) } -> std::same_as<bool>;
  /// A point, or its copy in the half-open period. \pre here and for near(), has_position(x).
  { space.position(x) } -> std::same_as<typename S::Position>;
  /// The k-th of the copies around a position; all are the same without periods.
  { space.copy(p, k) } -> std::same_as<typename S::Position>;
  /// The copy of a point that is nearest to a position.
  { space.near(x, p) } -> std::same_as<typename S::Position>;
  { space.coordinates(p) } -> std::same_as<Vec3>; ///< rounded; on the sphere a unit vector
  /// A position in the frame of another: relative to the sphere's centre, or to that position.
  { space.seen(p, p) } -> std::same_as<Vec3>;
  /// 1 when three positions run counter-clockwise, seen from outside; 0 on one line.
  { space.orientation(p, p, p) } -> std::same_as<int>;
  /// 1 when the last is inside the circle of the first three, counter-clockwise; 0 on it.
  { space.in_circle(p, p, p, p) } -> std::same_as<int>;
  { space.in_circle_resolved(p, p, p, p) } -> std::same_as<int>; ///< ties by the library's rule
  { space.compare_distances(p, p, p) } -> std::same_as<int>;     ///< -1: the second is nearer to p
  /// Whether the angle at the first is acute beyond rounding.
  { space.is_clearly_acute(p, p, p) } -> std::same_as<bool>;
  /// Whether a side is shorter than half of each period by more than rounding: no other copy is as
  /// near.
  { space.is_short(p, p) } -> std::same_as<bool>;
  { space.wrapped(x) } -> std::same_as<Vec3>;           ///< the copy in the half-open period
  { space.up(x) } -> std::same_as<Vec3>;                ///< the unit normal of the surface
  { space.offset(x, x) } -> std::same_as<Vec3>;         ///< the chord to the nearest copy
  { space.midpoint(x, x) } -> std::same_as<Vec3>;       ///< the same bits in either order
  { space.area_term(x, x, x) } -> std::same_as<double>; ///< twice the area, or nearly; signed
  /// The signed area of a triangle; in a periodic plane, of the copies that are nearest to the
  /// first point.
  { space.area(x, x, x) } -> std::same_as<double>;
  /// The circumcentre of the same triangle, counter-clockwise; on the sphere a unit vector, in a
  /// periodic plane inside the box.
  { space.circumcentre(x, x, x) } -> std::same_as<Vec3>;
};

static_assert(Space<Sphere> && Space<Plane>);

/// The space of this kind in which a surface lies.
template <Space S> S in_space([[maybe_unused]] const Surface& surface) {
  if constexpr (S::on_sphere)
    return {};
  else
    return S(surface.period());
}

/// Calls body(space) for the space in which a surface lies.
template <class Body> decltype(auto) in_space_of(const Surface& surface, const Body& body) {
  if (surface.is_sphere())
    return body(in_space<Sphere>(surface));
  return body(in_space<Plane>(surface));
}

/// \param thing what the points are, for the message: "site".
/// \throws Error invalid_argument with the index of the first point that has no position.
void require_positions(const Plane& plane, const PointsRef& points, const std::string& thing);
inline void require_positions(const Sphere&, const PointsRef&, const std::string&) {}

/// The unit vector of a direction of any norm; the same bits for any order of its coordinates.
Vec3 unit_of_any_norm(const Vec3& a);

} // namespace calotte::exact_detail
