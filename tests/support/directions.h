// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/generators.h>
#include <calotte/mesh.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <vector>

namespace calotte::test {

/// \param longitude, latitude degrees.
inline Eigen::Vector3d direction(double longitude, double latitude) {
  return from_lonlat(Eigen::Vector2d(longitude, latitude));
}

/// A line, or the corners of a ring.
/// \param places longitudes and latitudes, degrees.
inline Points3 directions(const std::vector<std::array<double, 2>>& places) {
  Points3 columns(3, std::ssize(places));
  for (std::size_t k = 0; k < places.size(); ++k)
    columns.col(static_cast<Eigen::Index>(k)) = direction(places[k][0], places[k][1]);
  return columns;
}

/// Radians between two directions.
inline double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace calotte::test
