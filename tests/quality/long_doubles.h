// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include <cmath>

/// For measures by their definitions, which have more digits than those of the library.
namespace calotte::test {

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;

/// Radians between two directions.
inline Real arc(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace calotte::test
