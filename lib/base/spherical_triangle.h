// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/spherical_angles.h"
#include "base/vec3.h"

namespace calotte::base_detail {

/// The sine and cosine of half an area, times a number from 0 to 4 that both share.
struct HalfArea {
  double sine, cosine;
};

/// The half area of a triangle of unit vectors, from -pi to pi. Its sine is positive if they run
/// counter-clockwise.
///
/// tan(area/2) = det(a,b,c) / ((a+b).(a+c)) (Van Oosterom and Strackee, IEEE Trans. Biomed. Eng.
/// 30, 1983). The determinant is one of small differences, which keep the digits of small
/// triangles. It loses digits where the arc from b to c comes near -a.
inline HalfArea half_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 side = dot(a, b) > 0 ? b - a : b + a;
  return {dot(a, cross(side, c - b)), dot(a + b, a + c)};
}

/// The area, positive if the unit vectors run counter-clockwise; the same bits on every machine.
inline double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const HalfArea half = half_area(a, b, c);
  return 2 * longitude_of(half.cosine, half.sine);
}

} // namespace calotte::base_detail
