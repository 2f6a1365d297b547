// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/planar_grid.h"

#include <calotte/error.h>

#include <cmath>
#include <utility>

namespace calotte::io_detail {
namespace {

void require_sorted(const DoubleVector& values, const std::string& file, const std::string& name) {
  if (values.size() < 2)
    throw Error(ErrorCode::parse, file + ": " + name +
                                      " has fewer than 2 values; give a grid that covers the "
                                      "domain");
  const bool descends = values[0] > values[1];
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) ||
        (i > 0 && !(descends ? values[i] < values[i - 1] : values[i] > values[i - 1])))
      throw Error(ErrorCode::parse, file + ": " + name + "[" + std::to_string(i) +
                                        "] is not finite and beyond the one before; sort the "
                                        "raster");
}

} // namespace

PlanarGrid ascending(PlanarGrid grid, const std::string& name, bool (*law)(double),
                     const std::string& fault) {
  require_sorted(grid.x, name, grid.x_name);
  require_sorted(grid.y, name, grid.y_name);
  for (Eigen::Index j = 0; j < grid.values.cols(); ++j)
    for (Eigen::Index i = 0; i < grid.values.rows(); ++i)
      if (!law(grid.values(i, j)) || !std::isfinite(grid.values(i, j)))
        throw Error(ErrorCode::parse, name + ": " + grid.value_name + "[" + std::to_string(j) +
                                          "][" + std::to_string(i) + "] is " + fault +
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

PlanarCellWidth checked(PlanarGrid grid, const std::string& name) {
  grid = ascending(
      std::move(grid), name, [](double value) { return value > 0; }, "not positive and finite");
  return {std::move(grid.x), std::move(grid.y), std::move(grid.values)};
}

} // namespace calotte::io_detail
