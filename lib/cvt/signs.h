// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "base/vec3.h"
#include "cvt/room.h"
#include "domain/periodic_box.h"
#include "exact/plane_predicates.h"
#include "mesh/connectivity.h"

#include <calotte/types.h>

#include <array>
#include <cstdint>

namespace calotte::cvt_detail {

/// The signs by which a mesh of moving points is judged, by the numbers of its sites. There is one
/// such class for each kind of mesh.
using Corners = std::array<std::int32_t, 3>; ///< of a triangle

/// The connectivity of a closed mesh of n generators.
/// \throws Error too_few_sites, when two of them have met or a hemisphere is empty.
Connectivity closed_connectivity(Mesh&& mesh, std::int64_t n);

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
  /// nearest is in doubt there, and periodic_delaunay() refuses what has such sides.
  bool is_counter_clockwise(const Corners& triangle) const;
  bool is_clearly_acute(const Corners& triangle, int v) const;
  bool circle_holds(const Corners& triangle, int v, std::int32_t d) const;

  /// \throws Error too_few_sites, when two points have met; as spherical_delaunay() and
  /// planar_delaunay().
  Connectivity triangulate() const;

private:
  bool periodic() const { return period_.x > 0; }
  Vec2 given(std::int32_t site) const { return {(*places_)[site].x, (*places_)[site].y}; }
  Image next_to(const Image& image, std::int32_t site) const;
  Vec2 offset(const Image& from, const Image& to) const;

  const Array<Vec3>* places_;
  Vec2 period_;
};

} // namespace calotte::cvt_detail
