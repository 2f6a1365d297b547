// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "base/vec3.h"
#include "cvt/room.h"
#include "delaunay/delaunay.h"
#include "domain/periodic_box.h"
#include "exact/plane_predicates.h"
#include "mesh/connectivity.h"

#include <calotte/types.h>

#include <array>
#include <cstdint>

namespace calotte::cvt_detail {

/// The predicates for a mesh of moving points, by site number. Each kind of mesh has one such
/// class.
using Corners = std::array<std::int32_t, 3>; ///< of a triangle

/// The connectivity of a closed mesh of n generators.
/// \throws Error too_few_sites if two of them coincide or a hemisphere is empty.
Connectivity closed_connectivity(Mesh&& mesh, std::int64_t n);

/// On the sphere: closed meshes of unit columns.
class SphereSigns {
public:
  explicit SphereSigns(const Points3& points) : points_(&points) {}

  std::int64_t sites() const { return points_->cols(); }
  bool is_counter_clockwise(const Corners& triangle) const;
  /// Evaluated up to rounding.
  /// \param v an index of the corners.
  bool is_clearly_acute(const Corners& triangle, int v) const;
  /// True if the circumcircle of a triangle contains d, the far corner of the triangle across from
  /// corner v; the library's rule resolves ties.
  bool circle_holds(const Corners& triangle, int v, std::int32_t d) const;

  /// \throws Error too_few_sites if two points coincide or a hemisphere is empty.
  Connectivity triangulate() const;

private:
  const Points3* points_;
};

/// In the plane, or in a doubly periodic box: places with z = 0, in a box inside it. Without a
/// period the last places are those of the hull, which do not move.
class PlaneSigns {
public:
  /// \param period 0 if there is none.
  PlaneSigns(const Array<Vec3>& places, const Vec2& period) : places_(&places), period_(period) {}

  std::int64_t sites() const { return places_->size(); }
  /// In a box a triangle with a side as long as half of a period is invalid: its nearest copies are
  /// ambiguous, and periodic_delaunay() rejects such sides.
  bool is_counter_clockwise(const Corners& triangle) const;
  bool is_clearly_acute(const Corners& triangle, int v) const;
  bool circle_holds(const Corners& triangle, int v, std::int32_t d) const;

  /// \throws Error too_few_sites if two points coincide; as spherical_delaunay() and
  ///         planar_delaunay().
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
