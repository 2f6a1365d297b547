// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_names.h"
#include "io/command.h"
#include "io/netcdf/cf_values.h"
#include "io/shapes/cell_width_file.h"
#include "io/shapes/planar_grid.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using io_detail::cf_values;
using io_detail::NetcdfReader;
using io_detail::PlanarGrid;

DoubleVector read_coordinate(const NetcdfReader& file, const std::string& name) {
  if (!file.has_variable(name) || file.shape_of(name).size() != 1)
    file.fail("no coordinate variable " + name + "; give " + name + "(" + name + ")");
  const std::vector<double> values = cf_values(file, name, {-1});
  return Eigen::Map<const DoubleVector>(values.data(), std::ssize(values));
}

/// A variable(y, x) with its coordinates, as stored.
PlanarGrid read_grid(const NetcdfReader& file, const std::string& variable) {
  if (!file.has_variable(variable))
    file.fail("no variable " + variable + "; give " + variable + "(y, x)");
  PlanarGrid grid{
      .x = read_coordinate(file, "x"), .y = read_coordinate(file, "y"), .value_name = variable};
  const std::vector<std::string> expected{file.dimensions_of("y")[0], file.dimensions_of("x")[0]};
  if (file.dimensions_of(variable) != expected)
    file.fail(variable + " is not " + variable + "(" + expected[0] + ", " + expected[1] +
              "); give it these dimensions, in this order");
  const std::vector<double> values = cf_values(file, variable, {grid.y.size(), grid.x.size()});
  grid.values = Eigen::Map<const DoubleMatrix>(values.data(), grid.x.size(), grid.y.size());
  return grid;
}

/// The factor that converts widths to the unit of x: 1 where either has none.
double unit_of_x(const NetcdfReader& file, const std::string& variable) {
  if (file.text(variable, "units").empty() || file.text("x", "units").empty())
    return 1;
  return io_detail::kilometres_of(file, variable) / io_detail::kilometres_of(file, "x");
}

PlanarCellWidth read_cell_width_of(const std::string& path) {
  const std::string variable = "cellWidth";
  const NetcdfReader file(path);
  PlanarCellWidth widths = checked(read_grid(file, variable), path);
  widths.widths *= unit_of_x(file, variable);
  return widths;
}

} // namespace

PlanarRaster read_planar_raster(const std::string& path) {
  PlanarGrid grid = ascending(
      read_grid(NetcdfReader(path), "density"), path, [](double value) { return value >= 0; },
      "negative, infinite or NaN");
  return {std::move(grid.x), std::move(grid.y), std::move(grid.values)};
}

PlanarCellWidth read_planar_cell_width(const std::string& path, const Surface& plane) {
  if (holds_rules(path))
    return sampled(read_width_rules(path, plane), plane);
  const std::string suffix = io_detail::suffix_of(path);
  io_detail::refuse_foreign(path);
  if (suffix != ".nc" && suffix != ".msh")
    throw Error(ErrorCode::invalid_argument,
                path + ": no file of cell widths in the plane; give NetCDF cellWidth(y, x) (.nc), "
                       "JIGSAW's spacings (.msh), or rules (.toml)");
  return suffix == ".msh" ? io_detail::read_planar_cell_width_msh(path) : read_cell_width_of(path);
}

} // namespace calotte
