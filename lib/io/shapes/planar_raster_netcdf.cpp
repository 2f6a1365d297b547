// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_reader.h"
#include "io/shapes/cell_width_file.h"

#include <calotte/read.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using io_detail::NetcdfReader;

DoubleVector coordinate(const NetcdfReader& file, const std::string& name) {
  if (!file.has_variable(name) || file.shape_of(name).size() != 1)
    file.fail("no coordinate variable " + name + "; give " + name + "(" + name + ")");
  const std::vector<double> values = file.doubles(name, {-1});
  const bool descends = values.size() > 1 && values.front() > values.back();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) ||
        (i > 0 && !(descends ? values[i] < values[i - 1] : values[i] > values[i - 1])))
      file.fail(name + "[" + std::to_string(i) +
                "] is not finite and beyond the one before; sort the raster");
  if (values.size() < 2)
    file.fail(name + " has fewer than 2 values; give a grid that covers the domain");
  return Eigen::Map<const DoubleVector>(values.data(), std::ssize(values));
}

/// A variable(y, x) with its coordinates, ascending.
struct Grid {
  DoubleVector x, y;
  DoubleMatrix values; ///< x by y
};

/// \param law which values are accepted. \param fault what others are.
Grid read_grid(const NetcdfReader& file, const std::string& variable, bool (*law)(double),
               const std::string& fault) {
  if (!file.has_variable(variable))
    file.fail("no variable " + variable + "; give " + variable + "(y, x)");
  Grid grid{coordinate(file, "x"), coordinate(file, "y"), {}};
  const std::vector<std::string> expected{file.dimensions_of("y")[0], file.dimensions_of("x")[0]};
  if (file.dimensions_of(variable) != expected)
    file.fail(variable + " is not " + variable + "(" + expected[0] + ", " + expected[1] +
              "); give it these dimensions, in this order");
  const std::vector<double> values = file.doubles(variable, {grid.y.size(), grid.x.size()});
  grid.values = Eigen::Map<const DoubleMatrix>(values.data(), grid.x.size(), grid.y.size());
  for (Eigen::Index j = 0; j < grid.values.cols(); ++j)
    for (Eigen::Index i = 0; i < grid.values.rows(); ++i)
      if (!law(grid.values(i, j)) || !std::isfinite(grid.values(i, j)))
        file.fail(variable + "[" + std::to_string(j) + "][" + std::to_string(i) + "] is " + fault +
                  "; correct it");
  if (grid.x[0] > grid.x[1]) {
    grid.x.reverseInPlace();
    grid.values.colwise().reverseInPlace();
  }
  if (grid.y[0] > grid.y[1]) {
    grid.y.reverseInPlace();
    grid.values.rowwise().reverseInPlace();
  }
  return grid;
}

/// The factor that converts widths to the unit of x: 1 where either has none.
double unit_of_x(const NetcdfReader& file, const std::string& variable) {
  if (file.text(variable, "units").empty() || file.text("x", "units").empty())
    return 1;
  return io_detail::kilometres_of(file, variable) / io_detail::kilometres_of(file, "x");
}

} // namespace

PlanarRaster read_planar_raster(const std::string& path) {
  Grid grid = read_grid(
      NetcdfReader(path), "density", [](double value) { return value >= 0; },
      "negative, infinite or NaN");
  return {std::move(grid.x), std::move(grid.y), std::move(grid.values)};
}

PlanarCellWidth read_planar_cell_width(const std::string& path) {
  const std::string variable = "cellWidth";
  const NetcdfReader file(path);
  Grid grid = read_grid(
      file, variable, [](double value) { return value > 0; }, "not positive and finite");
  grid.values *= unit_of_x(file, variable);
  return {std::move(grid.x), std::move(grid.y), std::move(grid.values)};
}

} // namespace calotte
