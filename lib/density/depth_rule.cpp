// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"
#include "base/require.h"
#include "density/raster_field.h"
#include "density/width_rules.h"

#include <calotte/widths.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace calotte {
namespace {

constexpr double gravity = 9.80665, rotation = 7.292e-5; // of the Earth, m/s^2 and 1/s
constexpr double radians = std::numbers::pi / 180;

/// The barotropic Rossby radius, metres; near the equator the equatorial one (Gill,
/// Atmosphere-Ocean Dynamics, 1982, Sect. 11.5).
/// \param radius of the sphere, metres.
double rossby_radius(double depth, double latitude, double radius) {
  const double speed = std::sqrt(gravity * depth),
               f = 2 * rotation * std::abs(std::sin(latitude * radians)),
               beta = 2 * rotation * std::cos(latitude * radians) / radius;
  return speed / std::max(f, std::sqrt(2 * beta * speed));
}

/// The slope of the sea floor, by central differences in both directions; at the ends of an axis by
/// one-sided differences.
class Slopes {
public:
  /// \param radius of the sphere, metres.
  Slopes(const Raster& raster, double radius) : raster_(raster), degree_(radius * radians) {}

  double operator()(Eigen::Index i, Eigen::Index j) const {
    const Eigen::Index columns = raster_.x.size(), rows = raster_.y.size();
    const Eigen::Index west = (i + columns - 1) % columns, east = (i + 1) % columns,
                       south = std::max<Eigen::Index>(j - 1, 0), north = std::min(j + 1, rows - 1);
    double across = raster_.x[east] - raster_.x[west];
    across -= 360 * std::floor(across / 360);
    const double cosine = std::cos(raster_.y[j] * radians), along_row = across * degree_ * cosine,
                 along_column = (raster_.y[north] - raster_.y[south]) * degree_;
    const double dx = along_row > 1
                          ? (raster_.values(east, j) - raster_.values(west, j)) / along_row
                          : 0, // at a pole
        dy = (raster_.values(i, north) - raster_.values(i, south)) / along_column;
    return std::sqrt(dx * dx + dy * dy);
  }

private:
  const Raster& raster_;
  double degree_; ///< metres
};

/// Whether a node or one of the eight around it is sea.
bool near_sea(const Raster& raster, Eigen::Index i, Eigen::Index j) {
  const Eigen::Index columns = raster.x.size(), rows = raster.y.size();
  for (Eigen::Index row = std::max<Eigen::Index>(j - 1, 0); row <= std::min(j + 1, rows - 1); ++row)
    for (const Eigen::Index column : {(i + columns - 1) % columns, i, (i + 1) % columns})
      if (raster.values(column, row) < 0)
        return true;
  return false;
}

Raster evaluate_rule(const Raster& raster, const DepthRule& rule, double radius) {
  using Kind = DepthRule::Kind;
  const Slopes slope(raster, radius);
  Raster widths{raster.x, raster.y, DoubleMatrix(raster.values.rows(), raster.values.cols())};
  base_detail::for_each_task(widths.y.size(), [&](std::int64_t j) {
    for (Eigen::Index i = 0; i < widths.x.size(); ++i) {
      const double depth = -raster.values(i, j);
      double length = 0; // metres
      if (depth > 0 && rule.kind == Kind::wavelength)
        length = std::sqrt(gravity * depth) * rule.period;
      else if (depth > 0 && rule.kind == Kind::rossby)
        length = rossby_radius(depth, raster.y[j], radius);
      else if (depth > 0)
        length = 2 * std::numbers::pi * depth / slope(i, j); // no demand where the floor is flat
      widths.values(i, j) = depth > 0 || near_sea(raster, i, j)
                                ? std::max(length / 1000 / rule.cells, rule.least)
                                : Widths::no_demand;
    }
  });
  return widths;
}

} // namespace

Widths Widths::by_depth(const Raster& raster, const DepthRule& rule) {
  using namespace density_detail;
  require_positive(rule.cells, "number of cells", "depths");
  require_positive(rule.least, "least width", "depths");
  if (rule.kind == DepthRule::Kind::wavelength)
    require_positive(rule.period, "period", "depths");
  require(!raster.of_plane, "depths are those of a raster of longitudes and latitudes; give one");
  require_values(raster, "heights", finite);
  return Widths(std::make_shared<WidthsOfRadius>(
      RuleSpace::sphere,
      [heights = std::make_shared<const Raster>(raster), rule](double radius_km) {
        return rule_of_field(evaluate_rule(*heights, rule, 1000 * radius_km));
      }));
}

} // namespace calotte
