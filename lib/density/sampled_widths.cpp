// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/sampled_widths.h"

#include "base/vector_loops.h"

#include <algorithm>
#include <utility>

namespace calotte::density_detail {
namespace {

CALOTTE_VECTOR_WIDTHS
void densities_of_widths(double least, std::size_t count, double* values) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t k = 0; k < count; ++k) {
    const double ratio = least / values[k], square = ratio * ratio;
    values[k] = square * square;
  }
}

RasterField checked_field(const Raster& widths) {
  require_widths(widths);
  return RasterField(widths);
}

} // namespace

SampledWidths::SampledWidths(const Raster& widths)
    : field_(checked_field(widths)), least_(widths.values.minCoeff()),
      greatest_(widths.values.maxCoeff()), count_(widths.values.size()),
      of_plane_(widths.of_plane) {}

SampledWidths::SampledWidths(WidthTiles tiles, double apart)
    : field_(std::move(tiles)), apart_(apart), of_plane_(std::get<WidthTiles>(field_).of_plane()) {
  const std::vector<double>& values = std::get<WidthTiles>(field_).values();
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  least_ = *least;
  greatest_ = *greatest;
  count_ = std::ssize(values);
  require_ratio(greatest_, least_);
}

void SampledWidths::operator()(const double* x, const double* y, const double* z, std::size_t count,
                               double* widths) const {
  std::visit([&](const auto& field) { field(x, y, z, count, widths); }, field_);
}

void SampledWidths::densities(const double* x, const double* y, const double* z, std::size_t count,
                              double* rho) const {
  (*this)(x, y, z, count, rho);
  densities_of_widths(least_, count, rho);
}

void SampledWidths::densities(const Eigen::Ref<const Points3>& points,
                              Eigen::Ref<Eigen::VectorXd> rho) const {
  evaluate_block(*this, points, rho);
  densities_of_widths(least_, static_cast<std::size_t>(rho.size()), rho.data());
}

} // namespace calotte::density_detail
