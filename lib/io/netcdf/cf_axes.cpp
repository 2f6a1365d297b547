// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/cf_axes.h"

#include "io/bytes/text.h"
#include "io/netcdf/cf_values.h"

#include <algorithm>
#include <numbers>

namespace calotte::io_detail {
namespace {

/// Whether a variable is a longitude or latitude by its name, its standard_name or its units. Units
/// of the CF conventions end in "_east", "_E" or "E".
bool is_geographic(const NetcdfReader& file, const std::string& name, const std::string& short_name,
                   const std::string& standard_name, const std::string& direction, char letter) {
  if (!file.is_numeric(name))
    return false;
  const std::string units = file.text(name, "units");
  return name == short_name || name == standard_name ||
         file.text(name, "standard_name") == standard_name || units.ends_with(direction) ||
         (units.starts_with("degree") && units.back() == letter);
}

/// Finds the first variables of one dimension for which is_axis(variable, dimension) is true.
template <class Is> RasterAxes find_axes(const NetcdfReader& file, const Is& is_axis) {
  RasterAxes axes;
  for (const std::string& name : file.variable_names()) {
    const std::vector<std::string> dimensions = file.dimensions_of(name);
    if (dimensions.size() != 1 || !is_axis(name, dimensions.front()))
      continue;
    if (axes.longitude.empty() && is_longitude(file, name))
      axes.longitude = name;
    else if (axes.latitude.empty() && is_latitude(file, name))
      axes.latitude = name;
  }
  return axes;
}

bool are_two(const NetcdfReader& file, const RasterAxes& axes) {
  return !axes.longitude.empty() && !axes.latitude.empty() &&
         file.dimensions_of(axes.longitude) != file.dimensions_of(axes.latitude);
}

} // namespace

bool is_longitude(const NetcdfReader& file, const std::string& variable) {
  return is_geographic(file, variable, "lon", "longitude", "_east", 'E');
}
bool is_latitude(const NetcdfReader& file, const std::string& variable) {
  return is_geographic(file, variable, "lat", "latitude", "_north", 'N');
}

std::optional<RasterAxes> raster_axes(const NetcdfReader& file) {
  const RasterAxes axes =
      find_axes(file, [](const std::string& name, const std::string& dimension) {
        return name == dimension;
      });
  return are_two(file, axes) ? std::optional(axes) : std::nullopt;
}

std::optional<RasterAxes> variable_axes(const NetcdfReader& file, const std::string& variable) {
  const std::vector<std::string> dimensions = file.dimensions_of(variable);
  const auto has = [&](const std::string& dimension) {
    return std::ranges::find(dimensions, dimension) != dimensions.end();
  };
  const auto on_it = [&](const std::string&, const std::string& dimension) {
    return has(dimension);
  };
  if (const std::optional<RasterAxes> axes = raster_axes(file);
      axes && has(axes->longitude) && has(axes->latitude))
    return axes;
  const RasterAxes axes = find_axes(file, on_it);
  return are_two(file, axes) ? std::optional(axes) : std::nullopt;
}

double degrees_per_unit(const NetcdfReader& file, const std::string& variable) {
  const std::string units = file.text(variable, "units");
  if (units.empty() || units.starts_with("deg"))
    return 1;
  if (units.starts_with("rad"))
    return 180 / std::numbers::pi;
  file.fail("the units of {} are {}; only degrees and radians of longitude and latitude are read",
            variable, in_quotes(units));
}

std::vector<double> read_degrees_of_axis(const NetcdfReader& file, const std::string& axis) {
  std::vector<double> values = cf_values(file, axis, {-1});
  scale(values, degrees_per_unit(file, axis));
  return values;
}

void scale(std::vector<double>& values, double factor) {
  if (factor != 1)
    for (double& value : values)
      value *= factor;
}

} // namespace calotte::io_detail
