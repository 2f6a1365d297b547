// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/raster_file.h"

#include <calotte/read.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace calotte {
namespace {

using namespace io_detail;

constexpr double slack = 1e-6; ///< of fractions that a program rounded

RasterLaw law_of(RasterValues values) {
  if (values == RasterValues::height)
    return {[](double height) { return std::isfinite(height); }, "finite"};
  return {[](double fraction) { return fraction >= -slack && fraction <= 1 + slack; },
          "a fraction from 0 to 1"};
}

double land_of(RasterValues values, double value) {
  if (values == RasterValues::height)
    return value < 0 ? 0 : 1;
  return std::clamp(values == RasterValues::land_fraction ? value : 1 - value, 0.0, 1.0);
}

} // namespace

LandRaster read_land_raster(const std::string& path, const std::string& variable,
                            RasterValues values) {
  const NetcdfReader file(path);
  Raster raster = read_raster(file, variable);
  const double scale = file.number(variable, "scale_factor", 1),
               offset = file.number(variable, "add_offset", 0);
  if (scale != 1 || offset != 0)
    raster.values.array() = raster.values.array() * scale + offset;
  raster = ordered(std::move(raster), path, law_of(values));
  raster.values = raster.values.unaryExpr([&](double value) { return land_of(values, value); });
  return {vector_of(raster.longitudes), vector_of(raster.latitudes), std::move(raster.values)};
}

} // namespace calotte
