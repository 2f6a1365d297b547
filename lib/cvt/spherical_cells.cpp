// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/spherical_cells.h"

#include "base/vector_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calotte::cvt_detail {

double SphericalCells::spacing() const {
  return std::sqrt(4 * std::numbers::pi / static_cast<double>(points_->cols()));
}

/// M = (M.x) x - gradient/2, with |M.x| = sqrt(|M|^2 - |gradient/2|^2).
Vec3 SphericalCells::centroid(const Vec3& x, const Vec3& gradient, double mass) {
  const double square = mass * mass - dot(gradient, gradient) / 4;
  const Vec3 first = std::copysign(std::sqrt(std::max(square, 0.0)), mass) * x - 0.5 * gradient;
  return (1 / norm(first)) * first;
}

void SphericalCells::retract(const Points3& x, double step, const Points3& d, Points3& to) {
  base_detail::retract(x, step, d, to);
}

void SphericalCells::make_tangential(Points3& vectors, const Points3& x, base_detail::Part part) {
  base_detail::make_tangential(vectors, x, part);
}

} // namespace calotte::cvt_detail
