// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/cf_axes.h"
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
    if (file.is_numeric(name) && axes_of(file, name))
      found.push_back(name);
  if (found.size() != 1)
    file.fail(std::to_string(found.size()) +
              " variables are rasters of latitudes and longitudes; name one, or give a file with "
              "one");
  return found.front();
}

/// Metres upwards for each unit of heights: km count a thousand times, and depths, which the
/// attribute positive or the standard name tells, downwards.
/// \throws Error parse, for another unit.
double metres_up(const NetcdfReader& file, const std::string& variable) {
  const std::string positive = file.text(variable, "positive"),
                    standard = file.text(variable, "standard_name"),
                    units = file.text(variable, "units");
  const bool down =
      positive == "down" || (positive.empty() && standard.find("depth") != std::string::npos);
  try {
    return (down ? -1 : 1) * (units.empty() ? 1 : std::round(1000 * kilometres_in(units)));
  } catch (const Error&) {
    file.fail(variable + ": the unit \"" + units + "\" is not one of heights; give m or km");
  }
}

Raster read_ordered(const NetcdfReader& file, const std::string& given, RasterValues values) {
  const std::string variable = given.empty() ? only_raster(file) : given;
  Raster raster = read_raster(file, variable);
  if (values == RasterValues::height) {
    const double factor = metres_up(file, variable);
    if (factor != 1)
      raster.values *= factor;
    if (factor < 0) // land has no depth
      raster.values =
          raster.values.unaryExpr([](double height) { return std::isnan(height) ? 0.0 : height; });
  } else if (file.text(variable, "units") == "%")
    raster.values /= 100;
  return ordered(std::move(raster), file.path(), law_of(values));
}

} // namespace

HeightRaster read_heights(const std::string& path, const std::string& variable) {
  Raster raster = read_ordered(NetcdfReader(path), variable, RasterValues::height);
  return {vector_of(raster.longitudes), vector_of(raster.latitudes), std::move(raster.values)};
}

LandRaster read_land_raster(const std::string& path, const std::string& variable,
                            RasterValues values) {
  Raster raster = read_ordered(NetcdfReader(path), variable, values);
  raster.values = raster.values.unaryExpr([&](double value) { return land_of(values, value); });
  return {vector_of(raster.longitudes), vector_of(raster.latitudes), std::move(raster.values)};
}

} // namespace calotte
