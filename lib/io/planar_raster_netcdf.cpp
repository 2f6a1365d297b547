// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf_reader.h"

#include <calotte/read.h>

#include <cmath>
#include <string>
#include <vector>

namespace calotte {
namespace {

using io_detail::NetcdfReader;

Eigen::VectorXd coordinate(const NetcdfReader& file, const std::string& name) {
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
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

void require_values(const NetcdfReader& file, const Eigen::MatrixXd& density) {
  for (Eigen::Index j = 0; j < density.cols(); ++j)
    for (Eigen::Index i = 0; i < density.rows(); ++i)
      if (!(density(i, j) >= 0) || !std::isfinite(density(i, j)))
        file.fail("density[" + std::to_string(j) + "][" + std::to_string(i) +
                  "] is negative, infinite or NaN; correct it");
}

} // namespace

PlanarRaster read_planar_raster(const std::string& path) {
  const NetcdfReader file(path);
  if (!file.has_variable("density"))
    file.fail("no variable density; give density(y, x)");
  PlanarRaster raster{coordinate(file, "x"), coordinate(file, "y"), {}};
  const std::vector<std::string> expected{file.dimensions_of("y")[0], file.dimensions_of("x")[0]};
  if (file.dimensions_of("density") != expected)
    file.fail("density is not density(" + expected[0] + ", " + expected[1] +
              "); give it these dimensions, in this order");
  const std::vector<double> values = file.doubles("density", {raster.y.size(), raster.x.size()});
  raster.density =
      Eigen::Map<const Eigen::MatrixXd>(values.data(), raster.x.size(), raster.y.size());
  require_values(file, raster.density);
  if (raster.x[0] > raster.x[1]) {
    raster.x.reverseInPlace();
    raster.density.colwise().reverseInPlace();
  }
  if (raster.y[0] > raster.y[1]) {
    raster.y.reverseInPlace();
    raster.density.rowwise().reverseInPlace();
  }
  return raster;
}

} // namespace calotte
