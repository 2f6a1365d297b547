// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/width_cones.h"

#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/vec3.h"
#include "density/raster_field.h"
#include "density/width_rules.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace calotte::density_detail {
namespace {

using base_detail::Vec3;

/// Rows of points at fixed latitudes from pole to pole, each at the same longitudes.
struct LatitudeRows {
  LatitudeRows(std::vector<double> of_columns, std::vector<double> of_rows)
      : longitudes(std::move(of_columns)), latitudes(std::move(of_rows)) {
    for (const double longitude : longitudes)
      round.push_back(base_detail::from_lonlat(longitude, 0));
  }
  std::vector<double> longitudes, latitudes; ///< degrees, latitudes ascending
  std::vector<Vec3> round;                   ///< the longitudes on the equator
};

LatitudeRows rows_of(const RasterField& field) {
  constexpr double degrees = 180 / std::numbers::pi;
  std::vector<double> longitudes, latitudes;
  const Axis &x = field.x(), &y = field.y();
  for (std::int64_t i = 0; i < x.intervals(); ++i) // the last node repeats the first
    longitudes.push_back(x[i] * degrees);
  for (std::int64_t j = 0; j <= y.intervals(); ++j)
    latitudes.push_back(y[j] * degrees);
  return {std::move(longitudes), std::move(latitudes)};
}

/// The rows of a raster `parts` times as fine.
LatitudeRows rows_of(const Raster& raster, int parts) {
  const Raster fine = regular_grid(180.0 / static_cast<double>((raster.y.size() - 1) * parts));
  return {{fine.x.begin(), fine.x.end()}, {fine.y.begin(), fine.y.end()}};
}

double distance(const Vec3& a, const Vec3& b) {
  return 2 * base_detail::arc_sine(std::min(1.0, 0.5 * norm(a - b)));
}

/// Lowers a row of the raster by the points within a step of its latitude.
void lower_row(const WidthRule& rule, const LatitudeRows& rows, double gradient, Eigen::Index j,
               Raster& raster) {
  const Eigen::Index columns = raster.x.size();
  const double step = 360 / static_cast<double>(columns), latitude = raster.y[j];
  const auto first =
                 std::upper_bound(rows.latitudes.begin(), rows.latitudes.end(), latitude - step),
             last = std::lower_bound(first, rows.latitudes.end(), latitude + step);
  std::vector<double> widths(rows.longitudes.size());
  std::vector<Vec3> row(widths.size());
  for (auto at = first; at != last; ++at) {
    const Vec3 meridian = base_detail::from_lonlat(0, *at);
    for (std::size_t k = 0; k < row.size(); ++k)
      row[k] = {meridian.x * rows.round[k].x, meridian.x * rows.round[k].y, meridian.z};
    rule.evaluate(row, widths);
    for (std::size_t k = 0; k < widths.size(); ++k) {
      const double longitude = rows.longitudes[k];
      const auto west = static_cast<Eigen::Index>(std::floor((longitude + 180) / step));
      for (const Eigen::Index beside : {west, west + 1}) {
        const Eigen::Index i = (beside % columns + columns) % columns;
        double& width = raster.values(i, j);
        if (widths[k] < width)
          width =
              std::min(width, widths[k] + gradient * distance(row[k], base_detail::from_lonlat(
                                                                          raster.x[i], latitude)));
      }
    }
  }
}

/// Gives all nodes of a row at a pole their minimum: they are one point.
void join_pole(Eigen::Index j, Raster& raster) {
  raster.values.col(j).setConstant(raster.values.col(j).minCoeff());
}

/// How many times as fine as the raster the rows are: some millions of points in all.
int parts_for(const Raster& raster) {
  constexpr double most = 4e6;
  return std::clamp(static_cast<int>(std::sqrt(most / static_cast<double>(raster.values.size()))),
                    1, 4);
}

} // namespace

Raster with_cones(const WidthRule& rule, Raster raster, double gradient) {
  const LatitudeRows rows =
      rule.field() != nullptr ? rows_of(*rule.field()) : rows_of(raster, parts_for(raster));
  base_detail::for_each_task(raster.y.size(),
                             [&](std::int64_t j) { lower_row(rule, rows, gradient, j, raster); });
  join_pole(0, raster);
  join_pole(raster.y.size() - 1, raster);
  return raster;
}

} // namespace calotte::density_detail
