// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curve/hilbert.h"
#include "curve/room.h"
#include "exact/space.h"

#include <calotte/matrices.h>

#include <algorithm>
#include <limits>

namespace calotte::curve_detail {

/// The squares that the curve fills, around points of a space.
template <Space S> class CurveSquares;

/// The faces of the cube.
template <> class CurveSquares<Sphere> {
public:
  static constexpr int count = 6;

  explicit CurveSquares(const Points3&) {}

  CubePoint operator()(const Vec3& x) const { return to_cube(x); }
  /// The inverse, up to scale.
  Vec3 point(const CubePoint& c) const { return from_cube(c); }
};

/// One square, which begins at the points' lowest coordinates and is as wide as the longer side of
/// their bounding box.
template <> class CurveSquares<Plane> {
public:
  static constexpr int count = 1;

  /// \pre there is a point; all are finite.
  explicit CurveSquares(const Points3& points) {
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
  Vec3 low_;
  double half_;
};

} // namespace calotte::curve_detail
