// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/extent.h"

#include "text/text.h"

#include <calotte/generators.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace calotte::tools {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// The latitudes of an arc: of its ends, and of its highest and lowest point if it passes them.
void take_latitudes(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                    std::array<double, 2>& y) {
  const auto take = [&y](const Eigen::Vector3d& x) {
    const double latitude = degrees * std::atan2(x.z(), std::hypot(x.x(), x.y()));
    y = {std::min(y[0], latitude), std::max(y[1], latitude)};
  };
  take(from);
  const Eigen::Vector3d normal = from.cross(to);
  const Eigen::Vector3d top = normal.squaredNorm() * Eigen::Vector3d::UnitZ() - normal.z() * normal;
  for (const double sign : {1.0, -1.0}) {
    const Eigen::Vector3d x = sign * top;
    if (normal.dot(from.cross(x)) > 0 && normal.dot(x.cross(to)) > 0)
      take(x);
  }
}

/// The longitudes between the ends of the widest gap that has none of them.
std::array<double, 2> spanned(std::vector<double> longitudes) {
  std::sort(longitudes.begin(), longitudes.end());
  double widest = longitudes.front() + 360 - longitudes.back();
  std::array<double, 2> span{longitudes.front(), longitudes.back()};
  for (std::size_t k = 1; k < longitudes.size(); ++k)
    if (const double gap = longitudes[k] - longitudes[k - 1]; gap > widest) {
      widest = gap;
      span = {longitudes[k], longitudes[k - 1]};
    }
  return span;
}

Extent extent_on_sphere(const Surface& surface) {
  Extent extent{.y = {90, -90}};
  std::vector<double> longitudes;
  for (const DoubleMatrix& ring : surface.rings())
    for (Eigen::Index i = 0; i < ring.cols(); ++i) {
      const Eigen::Vector3d from = ring.col(i).normalized(),
                            to = ring.col((i + 1) % ring.cols()).normalized();
      take_latitudes(from, to, extent.y);
      for (const Eigen::Vector3d& x : {from, Eigen::Vector3d((from + to).normalized())})
        longitudes.push_back(to_lonlat(x)(0, 0));
    }
  for (const double pole : {-1.0, 1.0})
    if (surface.contains({0, 0, pole})) {
      extent.all_around = true;
      extent.y[pole > 0 ? 1 : 0] = 90 * pole;
    }
  extent.x = spanned(std::move(longitudes));
  return extent;
}

} // namespace

Extent extent_of(const Surface& surface) {
  if (surface.is_sphere())
    return extent_on_sphere(surface);
  if (!surface.is_bounded())
    return {{0, surface.period().x()}, {0, surface.period().y()}};
  Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL), high = -low;
  for (const DoubleMatrix& ring : surface.rings()) {
    low = low.cwiseMin(ring.rowwise().minCoeff());
    high = high.cwiseMax(ring.rowwise().maxCoeff());
  }
  return {{low.x(), high.x()}, {low.y(), high.y()}};
}

std::string words_of(const Extent& extent, bool on_sphere) {
  const auto [x, y] = std::pair(extent.x, extent.y);
  const auto number = [](double value) { return formatted("%.6g", value); };
  if (!on_sphere)
    return message("x {} to {}, y {} to {}", number(x[0]), number(x[1]), number(y[0]),
                   number(y[1]));
  const auto longitude = [](double value) {
    return formatted("%.1f", std::abs(value)) + (value < 0 ? " W" : " E");
  };
  const auto latitude = [](double value) {
    return formatted("%.1f", std::abs(value)) + (value < 0 ? " S" : " N");
  };
  return message("{}, {} to {}",
                 extent.all_around ? "all longitudes"
                                   : message("{} to {}", longitude(x[0]), longitude(x[1])),
                 latitude(y[0]), latitude(y[1]));
}

} // namespace calotte::tools
