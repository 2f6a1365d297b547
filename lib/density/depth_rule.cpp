// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/require.h"
#include "density/width_rules.h"

#include <calotte/widths.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace calotte {
namespace {

using base_detail::require;
using base_detail::shortly;

constexpr double gravity = 9.80665, rotation = 7.292e-5; // of the Earth, m/s^2 and 1/s
constexpr double radians = std::numbers::pi / 180;

void require_positive(double value, const char* name) {
  require(value > 0 && std::isfinite(value), std::string("the ") + name + " of a rule of depths, " +
                                                 shortly(value) + ", is not positive; give one");
}

/// Of the barotropic wave; near the equator the equatorial one (Gill, Atmosphere-Ocean Dynamics,
/// 1982, Sect. 11.5).
/// \param radius of the sphere, metres.
double rossby_radius(double depth, double latitude, double radius) {
  const double speed = std::sqrt(gravity * depth),
               f = 2 * rotation * std::abs(std::sin(latitude * radians)),
               beta = 2 * rotation * std::cos(latitude * radians) / radius;
  return speed / std::max(f, std::sqrt(2 * beta * speed));
}

/// By differences of the neighbours in both directions; at an end of one, by one side.
class Slopes {
public:
  /// \param radius of the sphere, metres.
  Slopes(const HeightRaster& raster, double radius) : raster_(raster), degree_(radius * radians) {}

  double operator()(Eigen::Index i, Eigen::Index j) const {
    const Eigen::Index columns = raster_.longitudes.size(), rows = raster_.latitudes.size();
    const Eigen::Index west = (i + columns - 1) % columns, east = (i + 1) % columns,
                       south = std::max<Eigen::Index>(j - 1, 0), north = std::min(j + 1, rows - 1);
    double across = raster_.longitudes[east] - raster_.longitudes[west];
    across -= 360 * std::floor(across / 360);
    const double cosine = std::cos(raster_.latitudes[j] * radians),
                 along_row = across * degree_ * cosine,
                 along_column = (raster_.latitudes[north] - raster_.latitudes[south]) * degree_;
    const double dx = along_row > 1
                          ? (raster_.heights(east, j) - raster_.heights(west, j)) / along_row
                          : 0, // at a pole
        dy = (raster_.heights(i, north) - raster_.heights(i, south)) / along_column;
    return std::sqrt(dx * dx + dy * dy);
  }

private:
  const HeightRaster& raster_;
  double degree_; ///< metres
};

/// The sea at a node or one of the eight around it.
bool near_sea(const HeightRaster& raster, Eigen::Index i, Eigen::Index j) {
  const Eigen::Index columns = raster.longitudes.size(), rows = raster.latitudes.size();
  for (Eigen::Index row = std::max<Eigen::Index>(j - 1, 0); row <= std::min(j + 1, rows - 1); ++row)
    for (const Eigen::Index column : {(i + columns - 1) % columns, i, (i + 1) % columns})
      if (raster.heights(column, row) < 0)
        return true;
  return false;
}

CellWidth widths_of(const HeightRaster& raster, const DepthRule& rule, double radius) {
  using Kind = DepthRule::Kind;
  const Slopes slope(raster, radius);
  CellWidth widths{raster.longitudes, raster.latitudes,
                   DoubleMatrix(raster.heights.rows(), raster.heights.cols())};
  base_detail::for_each_task(widths.latitudes.size(), [&](std::int64_t j) {
    for (Eigen::Index i = 0; i < widths.longitudes.size(); ++i) {
      const double depth = -raster.heights(i, j);
      double length = 0; // metres
      if (depth > 0 && rule.kind == Kind::wavelength)
        length = std::sqrt(gravity * depth) * rule.period;
      else if (depth > 0 && rule.kind == Kind::rossby)
        length = rossby_radius(depth, raster.latitudes[j], radius);
      else if (depth > 0)
        length = 2 * std::numbers::pi * depth / std::max(slope(i, j), 1e-12);
      widths.widths(i, j) =
          depth > 0 || near_sea(raster, i, j)
              ? std::clamp(length / 1000 / rule.cells, rule.least, Widths::no_demand)
              : Widths::no_demand;
    }
  });
  return widths;
}

} // namespace

Widths Widths::by_depth(const HeightRaster& raster, const DepthRule& rule) {
  require_positive(rule.cells, "number of cells");
  require_positive(rule.least, "least width");
  if (rule.kind == DepthRule::Kind::wavelength)
    require_positive(rule.period, "period");
  require(raster.heights.rows() == raster.longitudes.size() &&
              raster.heights.cols() == raster.latitudes.size() && raster.heights.allFinite(),
          "heights are not finite, one for each longitude and latitude; correct the raster");
  using namespace density_detail;
  const Widths widths(std::make_shared<RuleOfRadius>(
      RuleSpace::sphere,
      [heights = std::make_shared<const HeightRaster>(raster), rule](double radius_km) {
        return Widths(widths_of(*heights, rule, 1000 * radius_km)).rule();
      }));
  widths.rule(); // refuses axes that are none
  return widths;
}

} // namespace calotte
