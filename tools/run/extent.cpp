// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/extent.h"

#include "options/numbers.h"
#include "text/text.h"

#include <calotte/generators.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

/// What the rings of a region say of its extent. Longitudes and latitudes in degrees.
struct PartBoundary {
  std::array<double, 2> latitudes{90, -90};
  std::vector<double> longitudes; ///< of points that are no poles
  std::array<bool, 2> at_pole{};  ///< whether it passes the south pole, the north pole
  bool goes_round = false;        ///< whether a ring surrounds the axis
};

/// Adds a point. \return its longitude; none at a pole.
std::optional<double> add_point(const Eigen::Vector3d& x, PartBoundary& boundary) {
  constexpr double rounding = 1e-12;
  const Points2 at = to_lonlat(x);
  std::array<double, 2>& y = boundary.latitudes;
  y = {std::min(y[0], at(1, 0)), std::max(y[1], at(1, 0))};
  if (x.head<2>().norm() < rounding * x.norm()) {
    boundary.at_pole[x.z() > 0 ? 1 : 0] = true;
    return std::nullopt;
  }
  boundary.longitudes.push_back(at(0, 0));
  return at(0, 0);
}

/// Adds an arc: its ends, its middle, and its highest and lowest point if it passes them.
/// \return degrees that it turns to the east; none if it passes a pole.
std::optional<double> add_arc(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                              PartBoundary& boundary) {
  bool passes_pole = !add_point(from + to, boundary);
  const Eigen::Vector3d normal = from.cross(to);
  const Eigen::Vector3d top = normal.squaredNorm() * Eigen::Vector3d::UnitZ() - normal.z() * normal;
  for (const double sign : {1.0, -1.0}) {
    const Eigen::Vector3d x = sign * top;
    if (normal.dot(from.cross(x)) > 0 && normal.dot(x.cross(to)) > 0)
      passes_pole |= !add_point(x, boundary);
  }
  const std::optional<double> west = add_point(from, boundary), east = add_point(to, boundary);
  return passes_pole || !west || !east ? std::nullopt
                                       : std::optional(std::remainder(*east - *west, 360));
}

void add_ring(const DoubleMatrix& ring, PartBoundary& boundary) {
  std::optional<double> turned = 0;
  for (Eigen::Index i = 0; i < ring.cols(); ++i) {
    const std::optional<double> turn =
        add_arc(ring.col(i).normalized(), ring.col((i + 1) % ring.cols()).normalized(), boundary);
    turned = turned && turn ? std::optional(*turned + *turn) : std::nullopt;
  }
  boundary.goes_round |= turned && std::abs(*turned) > 180;
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
  PartBoundary boundary;
  for (const DoubleMatrix& ring : surface.rings())
    add_ring(ring, boundary);
  Extent extent{.y = boundary.latitudes, .all_around = boundary.goes_round};
  for (const bool north : {false, true})
    if (const double pole = north ? 1 : -1; surface.contains({0, 0, pole})) {
      extent.y[north ? 1 : 0] = 90 * pole;
      extent.all_around |= !boundary.at_pole[north ? 1 : 0]; // the boundary is a part of it
    }
  extent.x = spanned(std::move(boundary.longitudes));
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
  return message("{}, {} to {}",
                 extent.all_around
                     ? "all longitudes"
                     : message("{} to {}", longitude_words(x[0]), longitude_words(x[1])),
                 latitude_words(y[0]), latitude_words(y[1]));
}

} // namespace calotte::tools
