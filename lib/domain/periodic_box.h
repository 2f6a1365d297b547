// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "domain/room.h"
#include "exact/plane_predicates.h"

#include <cmath>

/// Coordinates in a periodic plane, in doubles. A period of 0 means that the direction has none.
namespace calotte::domain_detail {

/// The shift of the copy of b nearest to a, in whole periods; 0 if there is no period.
inline double periods_between(double a, double b, double period) {
  return period > 0 ? -std::round((b - a) / period) : 0;
}

/// A coordinate's copy in [0, period), which keeps its bits there; x itself if there is no period.
inline double wrapped(double x, double period) {
  if (!(period > 0))
    return x;
  const double inside = x - std::floor(x / period) * period;
  return inside >= 0 && inside < period ? inside : 0;
}

/// True if an offset is below half of the period in each direction that has one.
inline bool within_half(const Vec2& offset, const Vec2& period) {
  return (!(period.x > 0) || std::abs(offset.x) < period.x / 2) &&
         (!(period.y > 0) || std::abs(offset.y) < period.y / 2);
}

/// The offset from a to b, or to the nearest copy of b.
inline Vec2 nearest_offset(const Vec3& a, const Vec3& b, const Vec2& period) {
  return {b.x - a.x + periods_between(a.x, b.x, period.x) * period.x,
          b.y - a.y + periods_between(a.y, b.y, period.y) * period.y};
}

} // namespace calotte::domain_detail
