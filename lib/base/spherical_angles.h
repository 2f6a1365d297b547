// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/elementary.h"

/// Longitude and latitude of vectors in radians, accurate to 1e-15, as fixed sequences of
/// operations (see elementary.h). std::atan2 differs between C libraries.
namespace calotte::base_detail {

/// atan2(sqrt(b), sqrt(a)) of two squares, which are not both below 1e-290 (0 is returned then).
CALOTTE_INLINE double angle_of_squares(double a, double b) {
  const bool steep = b > a;
  const double low = steep ? a : b;
  const double angle = arc_sine_of_root(low / (a + b + 1e-300));
  return steep ? 1.57079632679489661923 - angle : angle;
}

/// The longitude of a vector, from -pi to pi; 0 at the poles.
CALOTTE_INLINE double longitude_of(double x, double y) {
  const double angle = angle_of_squares(x * x, y * y);
  return std::copysign(x < 0 ? 3.14159265358979323846 - angle : angle, y);
}

/// The latitude of a vector, from -pi/2 to pi/2.
CALOTTE_INLINE double latitude_of(double x, double y, double z) {
  return std::copysign(angle_of_squares(x * x + y * y, z * z), z);
}

/// Moves an angle from [-turn/2, turn/2] to [0, turn).
CALOTTE_INLINE double eastern(double angle, double turn) {
  const double turned = angle < 0 ? angle + turn : angle;
  // An angle below 0 by less than the spacing of doubles at a turn is rounded to it; -0 becomes 0.
  return turned < turn ? turned + 0.0 : 0;
}

} // namespace calotte::base_detail
