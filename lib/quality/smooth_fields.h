// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "exact/space.h"
#include "quality/room.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

/// Smooth scalars for the measurement of errors. All of a set have one norm.
namespace calotte::quality_detail {

/// The real harmonics of degree 2 on the unit sphere, which satisfy div grad s = -6 s.
struct Harmonics {
  static constexpr std::size_t count = 5;
  using Values = std::array<double, count>;
  static constexpr double root = std::numbers::sqrt3;

  static Values values(const Vec3& p) {
    return {p.x * p.y, p.y * p.z, p.z * p.x, 0.5 * (p.x * p.x - p.y * p.y),
            (3 * p.z * p.z - 1) / (2 * root)};
  }
  /// Derivatives along a tangent.
  static Values slopes(const Vec3& p, const Vec3& d) {
    return {p.x * d.y + p.y * d.x, p.y * d.z + p.z * d.y, p.z * d.x + p.x * d.z,
            p.x * d.x - p.y * d.y, root * p.z * d.z};
  }
  /// |grad s|^2, which of the form p . A p is |2 A p|^2 - (2 s)^2.
  static Values squared_slopes(const Vec3& p) {
    const double x = p.x * p.x, y = p.y * p.y, z = p.z * p.z;
    Values out{x + y, y + z, z + x, x + y, (x + y + 4 * z) / 3};
    const Values s = values(p);
    for (std::size_t m = 0; m < count; ++m)
      out[m] -= 4 * s[m] * s[m];
    return out;
  }
  static Values laplacians(const Vec3& p) {
    Values out = values(p);
    for (double& value : out)
      value *= -6;
    return out;
  }

  /// The offset from a to b.
  static Vec3 offset(const Vec3& a, const Vec3& b) { return b - a; }
  /// The upward normal of the surface.
  static Vec3 up(const Vec3& p) { return p; }
  /// The midpoint of two points.
  static Vec3 middle(const Vec3& a, const Vec3& b) {
    const Vec3 sum = a + b;
    return (1 / norm(sum)) * sum;
  }
};

/// The longest waves of a box in the plane: cosine and sine along x and along y.
struct Waves {
  static constexpr std::size_t count = 4;
  using Values = std::array<double, count>;

  Vec3 low;      ///< a corner of the box
  double kx, ky; ///< wavenumbers
  Plane plane;

  Values values(const Vec3& p) const {
    const double x = kx * (p.x - low.x), y = ky * (p.y - low.y);
    return {std::cos(x), std::sin(x), std::cos(y), std::sin(y)};
  }
  Values slopes(const Vec3& p, const Vec3& d) const {
    const Values s = values(p);
    return {-kx * s[1] * d.x, kx * s[0] * d.x, -ky * s[3] * d.y, ky * s[2] * d.y};
  }
  Values squared_slopes(const Vec3& p) const {
    const Values x = slopes(p, {1, 0, 0}), y = slopes(p, {0, 1, 0});
    return {x[0] * x[0], x[1] * x[1], y[2] * y[2], y[3] * y[3]};
  }
  Values laplacians(const Vec3& p) const {
    const Values s = values(p);
    return {-kx * kx * s[0], -kx * kx * s[1], -ky * ky * s[2], -ky * ky * s[3]};
  }

  Vec3 offset(const Vec3& a, const Vec3& b) const { return plane.offset(a, b); }
  static Vec3 up(const Vec3&) { return {0, 0, 1}; }
  Vec3 middle(const Vec3& a, const Vec3& b) const { return a + 0.5 * offset(a, b); }
};

} // namespace calotte::quality_detail
