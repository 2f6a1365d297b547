// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "curve/hilbert.h"
#include "curve/room.h"

#include <calotte/matrices.h>

#include <algorithm>
#include <limits>

namespace calotte::curve_detail {

/// The square around points of the plane, for the curve along them: it begins at their lowest
/// coordinates and is as wide as the longer side of their bounding box.
class PlaneSquare {
public:
  PlaneSquare() = default;
  /// \pre there is a point; all are finite.
  explicit PlaneSquare(const Points3& points) {
    const Eigen::Vector3d low = points.rowwise().minCoeff();
    low_ = {low.x(), low.y(), 0};
    half_ = std::max((points.rowwise().maxCoeff() - low).maxCoeff() / 2,
                     std::numeric_limits<double>::min());
  }

  /// A point beyond the square is moved to its side.
  CubePoint operator()(const Vec3& x) const {
    const auto part = [&](double value, double low) {
      return std::clamp((value - low) / half_ - 1, -1.0, 1.0);
    };
    return {0, part(x.x, low_.x), part(x.y, low_.y)};
  }

  /// The inverse.
  Vec3 point(const CubePoint& c) const {
    return {low_.x + (c.u + 1) * half_, low_.y + (c.v + 1) * half_, 0};
  }

private:
  Vec3 low_{0, 0, 0};
  double half_ = 1;
};

} // namespace calotte::curve_detail
