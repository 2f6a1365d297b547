// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "voronoi/room.h"

#include <cmath>

namespace calotte::voronoi_detail {

/// The area of a triangle of unit vectors, positive if they run counter-clockwise. Oosterom and
/// Strackee (IEEE Trans. Biomed. Eng. 30, 1983), with differences in the product, which keep the
/// digits of small triangles.
inline double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2 * std::atan2(dot(a, cross(b - a, c - a)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

} // namespace calotte::voronoi_detail
