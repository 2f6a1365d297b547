// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/raster_file.h"
#include "io/bytes/file_error.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/cf_values.h"

#include "base/number_text.h"
#include "density/cell_width_field.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace calotte::io_detail {
namespace {

/// Tolerance in degrees for coordinates rounded in a file.
constexpr double degree_slack = 1e-3;

std::string element_name(const std::string& variable, std::size_t index) {
  return variable + "[" + std::to_string(index) + "]";
}

void require_ascending(const std::vector<double>& values, const std::string& variable,
                       const std::string& name) {
  if (values.size() < 2)
    fail_file(name, variable + " has fewer than 2 values; give a raster of the whole sphere");
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      fail_file(name, element_name(variable, i) + " is NaN or infinite; correct it");
    if (i > 0 && !(values[i] > values[i - 1]))
      fail_file(name, element_name(variable, i) + " = " + shortly(values[i]) + " does not follow " +
                          shortly(values[i - 1]) + "; sort the raster along it");
  }
}

/// The first meridian may be repeated at the end.
void drop_repeated_meridian(Raster& raster, const std::string& name) {
  const double around = raster.longitudes.back() - raster.longitudes.front() - 360;
  if (around > degree_slack)
    fail_file(name, raster.longitude_name +
                        " spans more than 360 degrees; remove the repeated longitudes");
  if (around < -degree_slack)
    return;
  const Eigen::Index last = raster.values.rows() - 1;
  for (Eigen::Index j = 0; j < raster.values.cols(); ++j)
    if (const double first = raster.values(0, j), again = raster.values(last, j);
        std::abs(again - first) > 1e-3 * std::abs(first))
      fail_file(name, raster.value_name + " differs at longitudes " +
                          shortly(raster.longitudes.front()) + " and " +
                          shortly(raster.longitudes.back()) + " of latitude " +
                          shortly(raster.latitudes[static_cast<std::size_t>(j)]) +
                          ", which are one place; make them equal or leave the last out");
  raster.longitudes.pop_back();
  raster.values.conservativeResize(last, Eigen::NoChange);
}

void require_law(const Raster& raster, const std::string& name, const RasterLaw& law) {
  for (Eigen::Index j = 0; j < raster.values.cols(); ++j)
    for (Eigen::Index i = 0; i < raster.values.rows(); ++i) {
      const double value = raster.values(i, j);
      if (law.holds(value))
        continue;
      const Eigen::Index first = raster.longitude_fastest ? j : i,
                         second = raster.longitude_fastest ? i : j;
      fail_file(name, raster.value_name + "[" + std::to_string(first) + "][" +
                          std::to_string(second) + "] = " + shortly(value) + " is not " + law.name +
                          "; correct it");
    }
}

/// \throws Error parse, for a file without.
RasterAxes require_axes(const NetcdfReader& file, const std::string& variable) {
  std::optional<RasterAxes> axes = axes_of(file, variable);
  if (!axes)
    axes = raster_axes(file);
  if (axes)
    return *axes;
  const std::vector<std::string> names = file.variable_names();
  const bool has_latitude = std::ranges::any_of(names, [&](const std::string& one) {
    return is_latitude(file, one) && file.dimensions_of(one) == std::vector{one};
  });
  const std::string name = has_latitude ? "lon" : "lat";
  file.fail("no coordinate variable " + name + "; give " + name + "(" + name + ") in degrees");
}

} // namespace

Raster ordered(Raster raster, const std::string& name, const RasterLaw& law,
               const Surface& region) {
  if (raster.latitudes.size() > 1 && raster.latitudes[1] < raster.latitudes[0]) {
    std::reverse(raster.latitudes.begin(), raster.latitudes.end());
    require_ascending(raster.latitudes, raster.latitude_name + " backwards", name);
    require_law(raster, name, law); // before the reversal, so that indices are those of the file
    raster.values.rowwise().reverseInPlace();
  }
  require_ascending(raster.longitudes, raster.longitude_name, name);
  require_ascending(raster.latitudes, raster.latitude_name, name);
  for (double& latitude : raster.latitudes) {
    if (std::abs(latitude) > 90 + degree_slack)
      fail_file(name, raster.latitude_name + " " + shortly(latitude) +
                          " is outside -90 to 90; give degrees");
    latitude = std::clamp(latitude, -90.0, 90.0);
  }
  require_ascending(raster.latitudes, raster.latitude_name, name); // still ascending after clamping
  require_law(raster, name, law);
  drop_repeated_meridian(raster, name);
  require_ascending(raster.longitudes, raster.longitude_name, name);
  const std::string problem =
      density_detail::uncovered(vector_of(raster.longitudes), vector_of(raster.latitudes), region,
                                raster.longitude_name, raster.latitude_name);
  if (!problem.empty())
    fail_file(name, problem);
  return raster;
}

Raster read_raster(const NetcdfReader& file, const std::string& variable) {
  if (!file.has_variable(variable))
    file.fail("no variable " + variable + "; give " + variable + "(lat, lon)");
  Raster raster;
  raster.value_name = variable;
  const RasterAxes axes = require_axes(file, variable);
  raster.latitude_name = axes.latitude;
  raster.longitude_name = axes.longitude;
  raster.latitudes = degrees_of(file, axes.latitude);
  raster.longitudes = degrees_of(file, axes.longitude);
  const auto rows = static_cast<std::int64_t>(raster.latitudes.size()),
             columns = static_cast<std::int64_t>(raster.longitudes.size());
  const std::vector<std::string> of_lat = file.dimensions_of(raster.latitude_name),
                                 of_lon = file.dimensions_of(raster.longitude_name);
  std::vector<std::string> of_values = file.dimensions_of(variable);
  std::erase_if(of_values, [&](const std::string& name) { // one time or level is no dimension
    return file.dimension(name) == 1 && name != of_lat[0] && name != of_lon[0];
  });
  raster.longitude_fastest = of_values == std::vector{of_lat[0], of_lon[0]};
  if (!raster.longitude_fastest && of_values != std::vector{of_lon[0], of_lat[0]})
    file.fail(variable + " is not " + variable + "(" + of_lat[0] + ", " + of_lon[0] +
              "); give it these dimensions");
  const std::vector<double> values = cf_values(file, variable, file.shape_of(variable));
  if (raster.longitude_fastest)
    raster.values = Eigen::Map<const DoubleMatrix>(values.data(), columns, rows);
  else
    raster.values = Eigen::Map<const DoubleMatrix>(values.data(), rows, columns).transpose();
  return raster;
}

} // namespace calotte::io_detail
