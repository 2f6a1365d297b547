// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/lonlat.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace calotte::test {

/// \param longitude, latitude degrees.
inline Eigen::Vector3d direction(double longitude, double latitude) {
  return from_lonlat(Eigen::Vector2d(longitude, latitude));
}

/// Radians between two directions.
inline double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace calotte::test
