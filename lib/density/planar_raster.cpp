// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/planar_raster.h>

#include "base/require.h"
#include "density/cell_width_field.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace calotte {
namespace {

using base_detail::require;
using density_detail::Axis;

void require_axis(const Eigen::VectorXd& values, const std::string& name) {
  require(values.size() >= 2,
          "density raster: fewer than 2 " + name + "; give a grid that covers the domain");
  for (Eigen::Index i = 0; i < values.size(); ++i)
    require(std::isfinite(values[i]) && (i == 0 || values[i] > values[i - 1]),
            "density raster: " + name + " " + std::to_string(i) +
                " is not finite and above the one before; sort them");
}

void require_raster(const PlanarRaster& raster) {
  require_axis(raster.x, "x");
  require_axis(raster.y, "y");
  require(raster.density.rows() == raster.x.size() && raster.density.cols() == raster.y.size(),
          "density raster: the values are not x by y; give one for each node");
  for (Eigen::Index j = 0; j < raster.y.size(); ++j)
    for (Eigen::Index i = 0; i < raster.x.size(); ++i)
      require(raster.density(i, j) >= 0 && std::isfinite(raster.density(i, j)),
              "density raster: density (" + std::to_string(i) + ", " + std::to_string(j) +
                  ") is negative, infinite or NaN; correct it");
}

/// A raster that finds intervals in constant time.
struct Field {
  Axis x, y;
  Eigen::MatrixXd density;

  double at(double px, double py) const {
    const std::int64_t i = x.interval(px), j = y.interval(py);
    const double u = x.fraction(i, px), v = y.fraction(j, py);
    const double low = density(i, j) + u * (density(i + 1, j) - density(i, j)),
                 high = density(i, j + 1) + u * (density(i + 1, j + 1) - density(i, j + 1));
    return low + v * (high - low);
  }
};

Axis axis_of(const Eigen::VectorXd& values) {
  return Axis(std::vector<double>(values.begin(), values.end()));
}

} // namespace

Density density_of(const PlanarRaster& raster) {
  require_raster(raster);
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [field = std::make_shared<const Field>(
                          Field{axis_of(raster.x), axis_of(raster.y), raster.density})](
                         const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      rho[i] = field->at(x(0, i), x(1, i));
  };
  return density;
}

} // namespace calotte
