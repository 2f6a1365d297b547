// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/raster_file.h"

#include <calotte/read.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

constexpr double fraction_slack = 1e-6; ///< of fractions that a program rounded

RasterLaw law_of(RasterValues values) {
  if (values == RasterValues::height)
    return {[](double height) { return std::isfinite(height); }, "finite"};
  return {
      [](double fraction) { return fraction >= -fraction_slack && fraction <= 1 + fraction_slack; },
      "a fraction from 0 to 1"};
}

double land_of(RasterValues values, double value) {
  if (values == RasterValues::height)
    return value < 0 ? 0 : 1;
  return std::clamp(values == RasterValues::land_fraction ? value : 1 - value, 0.0, 1.0);
}

std::string only_raster(const NetcdfReader& file) {
  std::vector<std::string> found;
  for (const std::string& name : file.variable_names())
    if (file.shape_of(name).size() == 2 && file.is_numeric(name))
      found.push_back(name);
  if (found.size() != 1)
    file.fail(std::to_string(found.size()) +
              " variables have two dimensions; name one, or give a file with one");
  return found.front();
}

Raster read_scaled(const NetcdfReader& file, const std::string& given, const RasterLaw& law) {
  const std::string variable = given.empty() ? only_raster(file) : given;
  Raster raster = read_raster(file, variable);
  const double scale = file.number(variable, "scale_factor", 1),
               offset = file.number(variable, "add_offset", 0);
  if (scale != 1 || offset != 0)
    raster.values.array() = raster.values.array() * scale + offset;
  return ordered(std::move(raster), file.path(), law);
}

} // namespace

HeightRaster read_heights(const std::string& path, const std::string& variable) {
  Raster raster = read_scaled(NetcdfReader(path), variable, law_of(RasterValues::height));
  return {vector_of(raster.longitudes), vector_of(raster.latitudes), std::move(raster.values)};
}

LandRaster read_land_raster(const std::string& path, const std::string& variable,
                            RasterValues values) {
  Raster raster = read_scaled(NetcdfReader(path), variable, law_of(values));
  raster.values = raster.values.unaryExpr([&](double value) { return land_of(values, value); });
  return {vector_of(raster.longitudes), vector_of(raster.latitudes), std::move(raster.values)};
}

} // namespace calotte
