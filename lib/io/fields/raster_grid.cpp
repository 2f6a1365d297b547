// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/fields/raster_grid.h"

#include "io/cells/model_grid.h"
#include "io/cells/netcdf_fields.h"
#include "io/netcdf/cf_values.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace calotte::io_detail {
namespace {

/// Whether a variable is a coordinate of its own dimension, and its attributes or name say which.
bool is_axis(const NetcdfReader& file, const std::string& variable, const std::string& standard,
             const std::string& short_name, const std::string& units) {
  if (file.dimensions_of(variable) != std::vector{variable} || !file.is_numeric(variable))
    return false;
  const std::string said = file.text(variable, "units");
  return variable == standard || variable == short_name ||
         file.text(variable, "standard_name") == standard || said.starts_with("degrees_" + units) ||
         said.starts_with("degree_" + units);
}

std::string axis_of(const NetcdfReader& file, const std::string& standard,
                    const std::string& short_name, const std::string& units) {
  for (const std::string& name : file.variable_names())
    if (is_axis(file, name, standard, short_name, units))
      return name;
  return "";
}

DoubleVector degrees_of(const NetcdfReader& file, const std::string& variable) {
  std::vector<double> values = cf_values(file, variable, {-1});
  scale(values, degrees_per_unit(file, variable));
  return Eigen::Map<const DoubleVector>(values.data(), std::ssize(values));
}

/// The sides of boxes that a variable of bounds gives, in the order of the nodes; none without.
/// \throws Error parse, where they leave gaps.
DoubleVector sides_of(const NetcdfReader& file, const std::string& axis,
                      const DoubleVector& nodes) {
  const std::string name = file.text(axis, "bounds");
  if (name.empty() || !file.has_variable(name))
    return {};
  std::vector<double> bounds = cf_values(file, name, {nodes.size(), 2});
  scale(bounds, degrees_per_unit(file, file.text(name, "units").empty() ? axis : name));
  const Eigen::Index n = nodes.size();
  const double sign = n > 1 && nodes[1] < nodes[0] ? -1 : 1;
  DoubleVector sides(n + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    double &first = bounds[static_cast<std::size_t>(2 * i)],
           &second = bounds[static_cast<std::size_t>(2 * i + 1)];
    if (sign * first > sign * second)
      std::swap(first, second);
    constexpr double rounding = 1e-4; // degrees, of floats
    if (i > 0 && !(std::abs(first - sides[i]) < rounding))
      file.fail(name + "[" + std::to_string(i) +
                "] does not begin where the one before ends; give "
                "bounds without gaps, or remove them");
    if (i == 0)
      sides[0] = first;
    sides[i + 1] = second;
  }
  return sides;
}

LonLatBoxes boxes_of(const NetcdfReader& file, const RasterAxes& axes) {
  const DoubleVector longitudes = degrees_of(file, axes.longitude),
                     latitudes = degrees_of(file, axes.latitude),
                     meridians = sides_of(file, axes.longitude, longitudes),
                     parallels = sides_of(file, axes.latitude, latitudes);
  try {
    LonLatBoxes boxes =
        meridians.size() > 0 && parallels.size() > 0
            ? LonLatBoxes{longitudes, latitudes, meridians, parallels.cwiseMin(90).cwiseMax(-90)}
            : lon_lat_boxes(longitudes, latitudes);
    require_boxes(boxes);
    return boxes;
  } catch (const Error& error) {
    file.fail(error.what());
  }
}

} // namespace

std::optional<RasterAxes> raster_axes(const NetcdfReader& file) {
  RasterAxes axes{axis_of(file, "longitude", "lon", "east"),
                  axis_of(file, "latitude", "lat", "north")};
  if (axes.longitude.empty() || axes.latitude.empty())
    return std::nullopt;
  return axes;
}

FieldGrid read_raster_grid(const NetcdfReader& file, const RasterAxes& axes, FieldChoice choice) {
  FieldGrid grid{.name = file.path()};
  grid.boxes = boxes_of(file, axes);
  read_fields_on(file, {axes.latitude, axes.longitude}, {axes.latitude, axes.longitude}, choice,
                 grid.fields, grid.ignored);
  return grid;
}

} // namespace calotte::io_detail
