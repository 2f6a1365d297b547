// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cell_width.h>

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/points.h"
#include "density/cell_width_field.h"
#include "density/sampling.h"
#include "domain/spherical_outline.h"

#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace calotte {
namespace {

using density_detail::WidthField;

void require_radius(double radius_km) {
  if (!(radius_km > 0) || !std::isfinite(radius_km))
    throw Error(ErrorCode::bad_option, "the sphere's radius must be positive; give it in km");
}

/// The widths at the columns of a block.
void evaluate_block(const WidthField& field, const Eigen::Ref<const Points3>& points,
                    Eigen::Ref<Eigen::VectorXd> widths) {
  constexpr Eigen::Index most = 128;
  std::array<std::array<double, most>, 3> rows;
  for (Eigen::Index begin = 0; begin < points.cols(); begin += most) {
    const Eigen::Index count = std::min(most, points.cols() - begin);
    for (Eigen::Index j = 0; j < count; ++j)
      for (Eigen::Index i = 0; i < 3; ++i)
        rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = points(i, begin + j);
    field(rows[0].data(), rows[1].data(), rows[2].data(), static_cast<std::size_t>(count),
          widths.data() + begin);
  }
}

/// The integral of 1/h^2 over the boxes between rows j and j + 1 of the unit sphere. Along a
/// parallel h is linear in a box, so that the integral is the box's length over the product of the
/// ends; across, Gauss' rule in the sine of the latitude, in which areas are uniform.
double integral_of_row(const WidthField& field, std::int64_t j) {
  constexpr std::array nodes{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                             0.8611363115940526};
  constexpr std::array weights{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                               0.3478548451374538};
  const double south = field.sine(j), half = 0.5 * (field.sine(j + 1) - south);
  double sum = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double latitude = base_detail::arc_sine(south + half * (1 + nodes[k]));
    const double v = field.latitudes().fraction(j, latitude);
    const auto at = [&](std::int64_t i) {
      return field.width(i, j) + v * (field.width(i, j + 1) - field.width(i, j));
    };
    double along = 0;
    for (std::int64_t i = 0; i < field.longitudes().intervals(); ++i)
      along += (field.longitudes()[i + 1] - field.longitudes()[i]) / (at(i) * at(i + 1));
    sum += weights[k] * half * along;
  }
  return sum;
}

struct Corner {
  double square = -1; ///< of the slope, per radian
  std::int64_t i = 0, j = 0;
};

/// The steepest corner of the boxes between rows j and j + 1. In a box dh/dlat is linear in
/// longitude and dh/dlon linear in latitude; divided by the cosine of the latitude, dh/dlon has no
/// inner maximum. Towards a pole, where both dh/dlon and the cosine vanish, it falls; the east
/// component is therefore 0 at the corners on a pole.
Corner steepest_of_row(const WidthField& field, std::int64_t j) {
  const double height = field.latitudes()[j + 1] - field.latitudes()[j];
  Corner steepest;
  for (const std::int64_t row : {j, j + 1}) {
    const bool pole = row == 0 || row == field.latitudes().intervals();
    for (std::int64_t i = 0; i < field.longitudes().intervals(); ++i) {
      const double step = field.longitudes()[i + 1] - field.longitudes()[i];
      const double east =
          pole ? 0 : (field.width(i + 1, row) - field.width(i, row)) / (step * field.cosine(row));
      for (const std::int64_t column : {i, i + 1}) {
        const double north = (field.width(column, j + 1) - field.width(column, j)) / height;
        const double square = east * east + north * north;
        if (square > steepest.square)
          steepest = {square, column, row};
      }
    }
  }
  return steepest;
}

CALOTTE_VECTOR_WIDTHS
void densities_of_widths(double least, std::size_t count, double* values) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t k = 0; k < count; ++k) {
    const double ratio = least / values[k], square = ratio * ratio;
    values[k] = square * square;
  }
}

} // namespace

namespace density_detail {

void WidthDensity::operator()(const Eigen::Ref<const Points3>& points,
                              Eigen::Ref<Eigen::VectorXd> rho) const {
  evaluate_block(*field_, points, rho);
  densities_of_widths(field_->least(), static_cast<std::size_t>(rho.size()), rho.data());
}

void WidthDensity::operator()(const double* x, const double* y, const double* z, std::size_t count,
                              double* rho) const {
  (*field_)(x, y, z, count, rho);
  densities_of_widths(field_->least(), count, rho);
}

} // namespace density_detail

Density density_of(const CellWidth& cell_width) {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = density_detail::WidthDensity(cell_width);
  return density;
}

Eigen::VectorXd evaluate(const CellWidth& cell_width, const PointsRef& points) {
  const base_detail::Points3Ref x = base_detail::directions_of(points);
  const WidthField field(cell_width);
  Eigen::VectorXd widths(x.cols());
  base_detail::for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    evaluate_block(field, x.middleCols(begin, end - begin), widths.segment(begin, end - begin));
  });
  return widths;
}

double implied_cells(const CellWidth& cell_width, double radius_km) {
  require_radius(radius_km);
  const WidthField field(cell_width);
  std::vector<double> rows(static_cast<std::size_t>(field.latitudes().intervals()));
  base_detail::for_each_task(field.latitudes().intervals(), [&](std::int64_t j) {
    rows[static_cast<std::size_t>(j)] = integral_of_row(field, j);
  });
  double sum = 0;
  for (const double row : rows)
    sum += row;
  return 2 / std::numbers::sqrt3 * radius_km * radius_km * sum;
}

double implied_cells(const CellWidth& cell_width, const Region& region, double radius_km) {
  if (region.whole())
    return implied_cells(cell_width, radius_km);
  require_radius(radius_km);
  constexpr std::int64_t samples = 1 << 18;
  const domain_detail::SphericalOutline outline(region);
  const Points3 places = density_detail::draw(samples, Density{}, outline, 1);
  const double mean = evaluate(cell_width, places).array().square().inverse().mean();
  return 2 / std::numbers::sqrt3 * radius_km * radius_km * outline.area() * mean;
}

Gradient largest_gradient(const CellWidth& cell_width, double radius_km) {
  require_radius(radius_km);
  const WidthField field(cell_width);
  std::vector<Corner> rows(static_cast<std::size_t>(field.latitudes().intervals()));
  base_detail::for_each_task(field.latitudes().intervals(), [&](std::int64_t j) {
    rows[static_cast<std::size_t>(j)] = steepest_of_row(field, j);
  });
  Corner steepest;
  for (const Corner& corner : rows)
    if (corner.square > steepest.square)
      steepest = corner;
  constexpr double degrees = 180 / std::numbers::pi;
  const double longitude = field.longitudes()[steepest.i] * degrees;
  return {std::sqrt(std::max(0.0, steepest.square)) / radius_km,
          longitude < 180 ? longitude : longitude - 360, field.latitudes()[steepest.j] * degrees};
}

} // namespace calotte
