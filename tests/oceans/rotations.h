// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/constants.h"

#include <Eigen/Geometry>

#include <vector>

namespace calotte::test {

/// None, north over a pole, across the date line, and one about no axis of the frame.
inline std::vector<Eigen::Matrix3d> rotations() {
  using Eigen::AngleAxisd;
  return {Eigen::Matrix3d::Identity(),
          AngleAxisd(-80 * degree, Eigen::Vector3d::UnitY()).toRotationMatrix(),
          AngleAxisd(179 * degree, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
          AngleAxisd(2, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix()};
}

} // namespace calotte::test
