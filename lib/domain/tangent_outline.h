// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "domain/clipped_cell.h"
#include "domain/outline.h"
#include "domain/room.h"
#include "domain/spherical_outline.h"

#include <cmath>
#include <optional>

namespace calotte::domain_detail {

/// The plane that touches the sphere at a point, with coordinates along two tangents. Projection
/// from the sphere's centre to it makes great circles straight lines. From outside the sphere the
/// second tangent is to the left of the first.
class TangentPlane {
public:
  /// \param at unit vector.
  explicit TangentPlane(const Vec3& at) : at_(at) {
    const double x = std::abs(at.x), y = std::abs(at.y), z = std::abs(at.z);
    const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    const Vec3 side = cross(axis, at);
    first_ = (1 / norm(side)) * side;
    second_ = cross(at, first_);
  }

  const Vec3& at() const { return at_; }
  double height(const Vec3& x) const { return dot(at_, x); } ///< positive in front
  Vec2 along(const Vec3& x) const { return {dot(first_, x), dot(second_, x)}; } ///< of a vector
  /// \pre height(x) > 0.
  Vec2 projected(const Vec3& x) const { return (1 / height(x)) * along(x); }
  /// A direction, of any norm.
  Vec3 lifted(const Vec2& u) const { return at_ + tangent(u); }
  Vec3 tangent(const Vec2& u) const { return u.x * first_ + u.y * second_; }

  /// The mirror image of 0: the point in the plane whose bisector with 0 is the projection of the
  /// bisector of x and the tangent point, which is the line u.t = 1 - x.at, t = along(x).
  Vec2 mirrored(const Vec3& x) const {
    const Vec2 t = along(x);
    const Vec3 apart = x - at_;
    return (dot(apart, apart) / dot(t, t)) * t; // 2 (1 - x.at) = |x - at|^2
  }

private:
  Vec3 at_, first_{0, 0, 0}, second_{0, 0, 0};
};

/// The boundary of a region of the sphere in the plane that touches the sphere at a site: Voronoi
/// cells and the region have straight sides there. It extends to some 76 degrees from the site.
class TangentOutline {
public:
  static constexpr double reach = 4; ///< in the plane

  TangentOutline(const SphericalOutline& outline, const TangentPlane& plane)
      : outline_(&outline), plane_(&plane) {}

  static const Box2& box() {
    static constexpr Box2 all{{-reach, -reach}, {reach, reach}};
    return all;
  }

  Side side(const Vec2& point) const { return outline_->side(plane_->lifted(point)); }

  /// Calls body(edge) for the edges, clipped to the part in front of the plane's horizon, whose box
  /// meets a box.
  template <class Body> void for_each_edge_near(const Box2& box, const Body& body) const {
    const Vec2 middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
    // A line of length l at a distance of at least 1 is seen under an angle of 2 atan(l/2) at most.
    const double radius = 2 * std::atan(norm(half) / 2);
    const Vec3 centre = plane_->lifted(middle);
    outline_->for_each_edge_near((1 / norm(centre)) * centre, 1.000001 * radius + 1e-12,
                                 [&](const SphericalOutline::Edge& edge) {
                                   if (const std::optional<Outline::Edge> line = projected(edge);
                                       line && meets(*line, box))
                                     body(*line);
                                 });
  }

private:
  /// The part of an edge slightly in front of the plane's horizon.
  std::optional<Outline::Edge> projected(const SphericalOutline::Edge& edge) const {
    constexpr double least = 0.01;
    const double from = plane_->height(edge.from), to = plane_->height(edge.to);
    if (from < least && to < least)
      return std::nullopt;
    const auto end = [&](const Vec3& x, double height, const Vec3& other, double beyond) {
      return height >= least
                 ? plane_->projected(x)
                 : plane_->projected(x + ((least - height) / (beyond - height)) * (other - x));
    };
    return Outline::Edge{end(edge.from, from, edge.to, to), end(edge.to, to, edge.from, from)};
  }

  static bool meets(const Outline::Edge& edge, const Box2& box) {
    return std::min(edge.from.x, edge.to.x) <= box.high.x &&
           std::max(edge.from.x, edge.to.x) >= box.low.x &&
           std::min(edge.from.y, edge.to.y) <= box.high.y &&
           std::max(edge.from.y, edge.to.y) >= box.low.y;
  }

  const SphericalOutline* outline_;
  const TangentPlane* plane_;
};

} // namespace calotte::domain_detail
