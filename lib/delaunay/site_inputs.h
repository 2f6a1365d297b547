// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "base/vec3.h"
#include "curve/hilbert.h"
#include "delaunay/room.h"
#include "delaunay/sites.h"
#include "exact/plane_predicates.h"
#include "exact/predicates.h"

#include <calotte/mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

/// The kinds of input points: their comparison and their position along the curve.
namespace calotte::delaunay_detail {

/// Directions of any norm.
struct Directions {
  const Points3Ref points;

  static constexpr std::int64_t fewest = 3;
  static constexpr const char* distinct = "distinct directions";
  static constexpr const char* domain = "the sphere";
  static constexpr const char* twin = "has the direction of";

  const Vec3& at(std::int64_t i) const { return column(points, i); }
  bool is_valid(std::int64_t i) const { return is_finite(at(i)) && !is_zero(at(i)); }
  void require_valid(std::int64_t i) const { require_direction(at(i), i); }
  CubePoint square(std::int64_t i) const { return to_cube(at(i)); }
  int compare(std::int64_t i, std::int64_t j) const {
    const Vec3 &p = at(i), &q = at(j);
    const bool equal_bits = p.x == q.x && p.y == q.y && p.z == q.z; // avoids exact arithmetic
    return equal_bits ? 0 : compare_directions(p, q);
  }
  bool same(std::int64_t i, std::int64_t j) const { return same_direction(at(i), at(j)); }
  static Vec3 unit(const Vec3& p) { return normalised(p); }
  /// The chord of an angle.
  static double distance(double within) {
    return 2 * std::sin(std::min(within, 3.141592653589793) / 2);
  }
  bool are_within(std::int64_t i, std::int64_t j, double within) const {
    return norm(unit(at(i)) - unit(at(j))) < distance(within);
  }
};

/// Points of the plane: pairs of doubles.
struct PlanePoints {
  const Points2Ref points;
  Frame frame;

  static constexpr std::int64_t fewest = 3;
  static constexpr const char* distinct = "distinct places";
  static constexpr const char* domain = "the plane";
  static constexpr const char* twin = "stands where";

  Vec3 at(std::int64_t i) const { return {points(0, i), points(1, i), 0}; }
  bool is_valid(std::int64_t i) const { return is_finite(at(i)); }
  void require_valid(std::int64_t i) const { require_finite(at(i), i); }
  CubePoint square(std::int64_t i) const {
    const Vec3 p = unit(at(i));
    return {0, p.x, p.y};
  }
  int compare(std::int64_t i, std::int64_t j) const {
    return exact_detail::compare({points(0, i), points(1, i)}, {points(0, j), points(1, j)});
  }
  bool same(std::int64_t i, std::int64_t j) const { return compare(i, j) == 0; }
  Vec3 unit(const Vec3& p) const {
    const Vec3 q = frame(p.x, p.y);
    return {std::clamp(q.x, -1.0, 1.0), std::clamp(q.y, -1.0, 1.0), 0};
  }
  double distance(double within) const { return within * frame.scale / frame.half; }
  /// Coordinates are halved, so that differences do not overflow, and in units of `within`, so that
  /// squares do not vanish.
  bool are_within(std::int64_t i, std::int64_t j, double within) const {
    const double dx = (points(0, i) / 2 - points(0, j) / 2) / (within / 2),
                 dy = (points(1, i) / 2 - points(1, j) / 2) / (within / 2);
    return dx * dx + dy * dy < 1;
  }
};

/// The frame of the finite points.
inline Frame frame_of(const Points2Ref& points) {
  double largest = 0;
  for (const double x : points.reshaped())
    if (std::isfinite(x))
      largest = std::max(largest, std::abs(x));
  Frame frame;
  if (largest > 0) // clamped so that the scale and the scaled values stay in the range of doubles
    frame.scale = std::ldexp(1.0, -std::clamp(std::ilogb(largest), -1000, 1000));
  Eigen::Array2d low(2, 2), high(-2, -2);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite()) {
      const Eigen::Array2d scaled = frame.scale * points.col(i).array();
      low = low.min(scaled);
      high = high.max(scaled);
    }
  if (largest > 0) {
    Eigen::Array2d centre = (low + high) / 2;
    // The curve crosses the middle lines of its square twice: a narrow box around one of them would
    // fall into two halves. The curve crosses once above the horizontal middle line and along the
    // left edge, so the frame puts narrow boxes there.
    const Eigen::Array2d extent = high - low;
    if (2 * extent.y() <= extent.x())
      centre.y() = low.y();
    else if (2 * extent.x() <= extent.y())
      centre.x() = low.x() + extent.y() / 2;
    const Eigen::Array2d half = (high - centre).max(centre - low); // the centre is rounded
    frame.centre = {centre.x(), centre.y(), 0};
    frame.half = half.maxCoeff() > 0 ? half.maxCoeff() : 1;
    low = (low - centre) / frame.half;
    high = (high - centre) / frame.half;
    frame.low = {low.x(), low.y()};
    frame.high = {high.x(), high.y()};
  }
  return frame;
}

/// Images of sites, as rounded points.
struct Images : PlanePoints {
  static bool same(std::int64_t, std::int64_t) { return false; }
};

} // namespace calotte::delaunay_detail
