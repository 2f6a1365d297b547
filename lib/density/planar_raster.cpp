// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/planar_raster.h>

#include "base/number_text.h"
#include "base/require.h"
#include "density/cell_width_field.h"
#include "density/planar_raster.h"
#include "density/sampling.h"
#include "domain/surface.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace calotte {
namespace {

using base_detail::require;
using base_detail::shortly;
using density_detail::Axis;
using density_detail::draw;
using density_detail::field_of;
using density_detail::PlanarField;
using domain_detail::require_plane;

const char* const rasters_are = "cell widths by x and y are";

void require_axis(const DoubleVector& values, const std::string& of, const std::string& name) {
  require(values.size() >= 2,
          of + ": fewer than 2 " + name + "; give a grid that covers the domain");
  for (Eigen::Index i = 0; i < values.size(); ++i)
    require(std::isfinite(values[i]) && (i == 0 || values[i] > values[i - 1]),
            of + ": " + name + " " + std::to_string(i) +
                " is not finite and above the one before; sort them");
}

void require_grid(const DoubleVector& x, const DoubleVector& y, const DoubleMatrix& values,
                  const std::string& of) {
  require_axis(x, of, "x");
  require_axis(y, of, "y");
  require(values.rows() == x.size() && values.cols() == y.size(),
          of + ": the values are not x by y; give one for each node");
}

/// \param name of one value. \param law what it must be, in words. \param fault what it is.
template <class Law>
void require_values(const DoubleMatrix& values, const std::string& name, const Law& law,
                    const std::string& fault) {
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    for (Eigen::Index i = 0; i < values.rows(); ++i)
      require(law(values(i, j)) && std::isfinite(values(i, j)),
              name + " (" + std::to_string(i) + ", " + std::to_string(j) + ") is " + fault +
                  "; correct it");
}

void require_raster(const PlanarRaster& raster) {
  const std::string of = "density raster";
  require_grid(raster.x, raster.y, raster.density, of);
  require_values(
      raster.density, of + ": density", [](double value) { return value >= 0; },
      "negative, infinite or NaN");
}

Axis axis_of(const DoubleVector& values) {
  return Axis(std::vector<double>(values.begin(), values.end()));
}

double widest_step(const DoubleVector& values) {
  return (values.tail(values.size() - 1) - values.head(values.size() - 1)).maxCoeff();
}

void require_extent(const DoubleVector& nodes, double low, double high, const std::string& name) {
  const double slack = 0.5 * widest_step(nodes), first = nodes[0], last = nodes[nodes.size() - 1];
  require(low >= first - slack && high <= last + slack,
          "cell width: " + name + " runs from " + shortly(first) + " to " + shortly(last) +
              ", but the domain from " + shortly(low) + " to " + shortly(high) +
              "; give widths that cover the domain");
}

} // namespace

void density_detail::require_widths(const PlanarCellWidth& widths) {
  const std::string of = "cell width";
  require_grid(widths.x, widths.y, widths.widths, of);
  require_values(
      widths.widths, of + ": width", [](double value) { return value > 0; },
      "not positive and finite");
}

PlanarCellWidth density_detail::grid_over(const Eigen::Vector2d& low, const Eigen::Vector2d& size,
                                          double step, double most_nodes) {
  const auto intervals = [&](int k) { return std::max(1.0, std::ceil(size[k] / step)); };
  while ((intervals(0) + 1) * (intervals(1) + 1) > most_nodes)
    step *= 1.25;
  const auto axis = [&](int k) {
    const auto nodes = static_cast<Eigen::Index>(intervals(k)) + 1;
    return DoubleVector(DoubleVector::LinSpaced(nodes, low[k], low[k] + size[k]));
  };
  PlanarCellWidth grid{axis(0), axis(1), {}};
  grid.widths.resize(grid.x.size(), grid.y.size());
  return grid;
}

density_detail::PlanarField density_detail::field_of(const PlanarCellWidth& widths) {
  require_widths(widths);
  return {axis_of(widths.x), axis_of(widths.y), widths.widths};
}

Density density_of(const PlanarRaster& raster) {
  require_raster(raster);
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [field = std::make_shared<const PlanarField>(
                          PlanarField{axis_of(raster.x), axis_of(raster.y), raster.density})](
                         const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      rho[i] = field->at(x(0, i), x(1, i));
  };
  return density;
}

Density density_of(const PlanarCellWidth& cell_width) {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [field = std::make_shared<const PlanarField>(field_of(cell_width)),
                      least = cell_width.widths.minCoeff()](const Eigen::Ref<const Points3>& x,
                                                            Eigen::Ref<Eigen::VectorXd> rho) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const double ratio = least / field->at(x(0, i), x(1, i)), square = ratio * ratio;
      rho[i] = square * square;
    }
  };
  return density;
}

double implied_cells(const PlanarCellWidth& cell_width, const Surface& surface) {
  require_plane(surface, rasters_are);
  constexpr std::int64_t samples = 1 << 18;
  const PlanarField field = field_of(cell_width);
  const Points3 places = draw(samples, Density{}, surface, 1);
  double sum = 0;
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const double width = field.at(places(0, i), places(1, i));
    sum += 1 / (width * width);
  }
  return 2 / std::numbers::sqrt3 * surface.area() * (sum / static_cast<double>(samples));
}

void require_covering(const PlanarCellWidth& cell_width, const Surface& surface) {
  require_plane(surface, rasters_are);
  density_detail::require_widths(cell_width);
  domain_detail::require_finite_plane(surface);
  const Surface::Rings& rings = surface.rings();
  Eigen::Vector2d low(0, 0), high = surface.period();
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Eigen::Vector2d least = rings[i].rowwise().minCoeff(),
                          most = rings[i].rowwise().maxCoeff();
    low = i == 0 ? least : Eigen::Vector2d(low.cwiseMin(least));
    high = i == 0 ? most : Eigen::Vector2d(high.cwiseMax(most));
  }
  require_extent(cell_width.x, low.x(), high.x(), "x");
  require_extent(cell_width.y, low.y(), high.y(), "y");
}

} // namespace calotte
