// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "memory.h"
#include "plane_predicates.h"
#include "vec3.h"

#include <calotte/types.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace calotte::detail {

/// A mesh without its points, which move.
struct Connectivity {
  Triangles triangles; ///< counter-clockwise, in any order
  Triangles
      neighbours; ///< as Mesh's; -1 only where no movement can make an edge other than Delaunay
};

/// The signs by which a mesh of moving points is judged, by the numbers of its sites. There is one
/// such class for each kind of mesh.
using Corners = std::array<std::int32_t, 3>; ///< of a triangle

/// On the sphere: closed meshes of unit columns.
class SphereSigns {
public:
  explicit SphereSigns(const Points3& points) : points_(&points) {}

  std::int64_t sites() const { return points_->cols(); }
  bool is_counter_clockwise(const Corners& triangle) const;
  /// Up to rounding. \param v an index of the corners.
  bool is_clearly_acute(const Corners& triangle, int v) const;
  /// Whether the circle of a triangle holds d, the far corner of the triangle that is beyond the
  /// edge across from corner v; ties by the library's rule.
  bool circle_holds(const Corners& triangle, int v, std::int32_t d) const;

  /// \throws Error too_few_sites, when two points have met or a hemisphere is empty.
  Connectivity triangulate() const;

private:
  const Points3* points_;
};

/// In the plane, or in a doubly periodic box: places with z = 0, in the latter inside it. Without a
/// period the last places are those of the hull, which never move.
class PlaneSigns {
public:
  /// \param period 0 where there is none.
  PlaneSigns(const Array<Vec3>& places, const Vec2& period) : places_(&places), period_(period) {}

  std::int64_t sites() const { return places_->size(); }
  /// In a box no triangle is that has a side as long as half of a period: which copies are the
  /// nearest is in doubt there, and delaunay() refuses what has such sides.
  bool is_counter_clockwise(const Corners& triangle) const;
  bool is_clearly_acute(const Corners& triangle, int v) const;
  bool circle_holds(const Corners& triangle, int v, std::int32_t d) const;

  /// \throws Error too_few_sites, when two points have met; as delaunay().
  Connectivity triangulate() const;

private:
  bool periodic() const { return period_.x > 0; }
  Vec2 given(std::int32_t site) const { return {(*places_)[site].x, (*places_)[site].y}; }
  Image next_to(const Image& image, std::int32_t site) const;
  Vec2 offset(const Image& from, const Image& to) const;

  const Array<Vec3>* places_;
  Vec2 period_;
};

/// The copy of b nearest to a, in whole periods: 0 where there is none.
inline double periods_between(double a, double b, double period) {
  return period > 0 ? -std::round((b - a) / period) : 0;
}

/// A coordinate's copy in [0, period).
inline double wrapped(double x, double period) {
  const double inside = x - std::floor(x / period) * period;
  return inside >= 0 && inside < period ? inside : 0;
}

/// Whether an offset is below half of the period in both directions. True where there is none.
inline bool within_half(const Vec2& offset, const Vec2& period) {
  return !(period.x > 0) ||
         (std::abs(offset.x) < period.x / 2 && std::abs(offset.y) < period.y / 2);
}

/// From a to b, or to the nearest copy of b.
inline Vec2 nearest_offset(const Vec3& a, const Vec3& b, const Vec2& period) {
  return {b.x - a.x + periods_between(a.x, b.x, period.x) * period.x,
          b.y - a.y + periods_between(a.y, b.y, period.y) * period.y};
}

} // namespace calotte::detail
