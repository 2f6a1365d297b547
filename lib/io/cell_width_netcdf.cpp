// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cell_width_file.h"
#include "io/netcdf_reader.h"

#include <cmath>
#include <limits>

namespace calotte::io_detail {
namespace {

/// Returns the first of the names that is a variable of one dimension in the file.
std::string coordinate(const NetcdfReader& file, const std::string& name,
                       const std::string& long_name) {
  for (const std::string& candidate : {name, long_name})
    if (file.has_variable(candidate) && file.shape_of(candidate).size() == 1)
      return candidate;
  file.fail("no coordinate variable " + name + "; give " + name + "(" + name + ") in degrees");
}

/// Replaces fill values by NaN.
void drop_fill(const NetcdfReader& file, const std::string& variable, Eigen::MatrixXd& values) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (const std::string attribute : {"_FillValue", "missing_value"}) {
    const double fill = file.number(variable, attribute, none);
    if (!std::isnan(fill))
      values = values.unaryExpr([&](double value) { return value == fill ? none : value; }).eval();
  }
}

bool in_metres(const std::string& units) {
  return units == "m" || units == "metre" || units == "metres" || units == "meter" ||
         units == "meters";
}

} // namespace

CellWidth read_cell_width_netcdf(const std::string& path, const std::string& variable) {
  const NetcdfReader file(path);
  if (!file.has_variable(variable))
    file.fail("no variable " + variable + "; give " + variable + "(lat, lon)");
  Raster raster;
  raster.width_name = variable;
  raster.latitude_name = coordinate(file, "lat", "latitude");
  raster.longitude_name = coordinate(file, "lon", "longitude");
  raster.latitudes = file.doubles(raster.latitude_name, {-1});
  raster.longitudes = file.doubles(raster.longitude_name, {-1});
  const auto rows = static_cast<std::int64_t>(raster.latitudes.size()),
             columns = static_cast<std::int64_t>(raster.longitudes.size());
  const std::vector<std::string> of_lat = file.dimensions_of(raster.latitude_name),
                                 of_lon = file.dimensions_of(raster.longitude_name),
                                 of_width = file.dimensions_of(variable);
  if (of_width != std::vector{of_lat[0], of_lon[0]})
    file.fail(variable + " is not " + variable + "(" + of_lat[0] + ", " + of_lon[0] +
              "); give it these dimensions, in this order");
  const std::vector<double> values = file.doubles(variable, {rows, columns});
  raster.widths = Eigen::Map<const Eigen::MatrixXd>(values.data(), columns, rows);
  drop_fill(file, variable, raster.widths);
  if (in_metres(file.text(variable, "units")))
    raster.widths /= 1000;
  return checked(std::move(raster), path);
}

} // namespace calotte::io_detail
