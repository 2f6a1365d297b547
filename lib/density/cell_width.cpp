// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cell_width.h>

#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "density/cell_width_field.h"
#include "density/sampling.h"
#include "domain/spherical_outline.h"
#include "domain/surface.h"

#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace calotte {
namespace {

using base_detail::shortly;
using density_detail::require_radius;
using density_detail::WidthField;
using domain_detail::require_sphere;

const char* const widths_are = "cell widths by longitude and latitude are";

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

/// How far from the end of an interval the middle of a cell is: half of its width, as a part of the
/// interval, or the middle of the interval.
double middle_of_cell(double width, double interval) {
  return std::min(0.5, 0.5 * width / interval);
}

/// The steepest corner of the boxes between rows j and j + 1. In a box dh/dlat is linear in
/// longitude and dh/dlon linear in latitude, so that the mean over the cell in a corner is the
/// value at its middle. \param radians of a width of 1.
Corner steepest_of_row(const WidthField& field, std::int64_t j, double radians) {
  const double height = field.latitudes()[j + 1] - field.latitudes()[j];
  Corner steepest;
  for (std::int64_t i = 0; i < field.longitudes().intervals(); ++i) {
    const double length = field.longitudes()[i + 1] - field.longitudes()[i];
    const double south = field.width(i + 1, j) - field.width(i, j),
                 north = field.width(i + 1, j + 1) - field.width(i, j + 1),
                 west = field.width(i, j + 1) - field.width(i, j),
                 east = field.width(i + 1, j + 1) - field.width(i + 1, j);
    for (const std::int64_t row : {j, j + 1})
      for (const std::int64_t column : {i, i + 1}) {
        const double width = field.width(column, row) * radians;
        const double up = middle_of_cell(width, height), v = row == j ? up : 1 - up;
        const double cosine = std::cos(field.latitudes()[j] + v * height);
        const double along = middle_of_cell(width, length * cosine),
                     u = column == i ? along : 1 - along;
        const double dx = (south + v * (north - south)) / (length * cosine),
                     dy = (west + u * (east - west)) / height;
        if (const double square = dx * dx + dy * dy; square > steepest.square)
          steepest = {square, column, row};
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

void require_radius(double radius_km) {
  if (!(radius_km > 0) || !std::isfinite(radius_km))
    throw Error(ErrorCode::invalid_argument, "the sphere's radius must be positive; give it in km");
}

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

DoubleVector evaluate(const CellWidth& cell_width, const PointsRef& points) {
  const base_detail::Points3Ref x = base_detail::directions_of(points);
  const WidthField field(cell_width);
  DoubleVector widths(x.cols());
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

double implied_cells(const CellWidth& cell_width, const Surface& surface, double radius_km) {
  require_sphere(surface, widths_are);
  if (!surface.is_bounded())
    return implied_cells(cell_width, radius_km);
  require_radius(radius_km);
  constexpr std::int64_t samples = 1 << 18;
  const Points3 places = density_detail::draw(samples, Density{}, surface, 1);
  const double mean = evaluate(cell_width, places).array().square().inverse().mean();
  return 2 / std::numbers::sqrt3 * radius_km * radius_km * surface.area() * mean;
}

namespace density_detail {
namespace {

double widest_step(const DoubleVector& values) {
  return (values.tail(values.size() - 1) - values.head(values.size() - 1)).maxCoeff();
}

/// The part of the sphere that the nodes of a raster cover, in degrees.
struct Cover {
  double west, length, south, north;       ///< with half of the widest steps
  bool around = false;                     ///< covers all longitudes
  bool to_south = false, to_north = false; ///< covers a pole

  bool whole() const { return around && to_south && to_north; }

  bool holds(const Eigen::Vector3d& x) const {
    const auto [longitude, latitude] = base_detail::lonlat_of({x.x(), x.y(), x.z()});
    if ((latitude < south && !to_south) || (latitude > north && !to_north))
      return false;
    const double east = longitude - west;
    return around || east - 360 * std::floor(east / 360) <= length;
  }
};

Cover cover_of(const DoubleVector& longitudes, const DoubleVector& latitudes) {
  constexpr double slack = 1e-3; // degrees, for coordinates rounded in a file
  const double step = widest_step(longitudes), rise = widest_step(latitudes);
  const double first = longitudes[0], last = longitudes[longitudes.size() - 1],
               bottom = latitudes[0], top = latitudes[latitudes.size() - 1];
  Cover cover{first - step / 2 - slack, last - first + step + 2 * slack, bottom - rise / 2 - slack,
              top + rise / 2 + slack};
  cover.around = 360 - (last - first) <= 1.5 * step + slack;
  cover.to_south = bottom + 90 <= 1.5 * rise + slack;
  cover.to_north = 90 - top <= 1.5 * rise + slack;
  return cover;
}

/// A place of the region that is not covered, if there is one: on the boundary, which is sampled,
/// or else the region holds all of a part that is not covered.
std::optional<Eigen::Vector3d> place_outside(const Cover& cover, const Surface& region) {
  constexpr double apart = 1e-3; // radians
  for (const Points3 ring : region.rings())
    for (Eigen::Index i = 0; i < ring.cols(); ++i) {
      const Eigen::Vector3d from = ring.col(i).normalized(),
                            to = ring.col((i + 1) % ring.cols()).normalized();
      const auto parts = static_cast<int>((to - from).norm() / apart) + 1;
      for (int k = 0; k < parts; ++k) {
        const Eigen::Vector3d at = from + (to - from) * (double(k) / parts);
        if (!cover.holds(at))
          return at;
      }
    }
  std::vector<Eigen::Vector3d> others;
  if (!cover.to_south || !cover.around)
    others.emplace_back(0, 0, -1);
  if (!cover.to_north || !cover.around)
    others.emplace_back(0, 0, 1);
  if (!cover.around) {
    const double opposite =
        (cover.west + cover.length / 2 + 180) * std::numbers::pi / 180; // of its middle
    others.emplace_back(std::cos(opposite), std::sin(opposite), 0);
  }
  for (const Eigen::Vector3d& at : others)
    if (region.contains(at))
      return at;
  return std::nullopt;
}

} // namespace

std::string uncovered(const DoubleVector& longitudes, const DoubleVector& latitudes,
                      const Surface& region, const std::string& longitude,
                      const std::string& latitude) {
  const Cover cover = cover_of(longitudes, latitudes);
  if (cover.whole())
    return {};
  const auto extent = [](const std::string& name, const DoubleVector& values) {
    return name + " runs from " + shortly(values[0]) + " to " + shortly(values[values.size() - 1]);
  };
  if (!region.is_bounded())
    return (cover.around ? extent(latitude, latitudes) : extent(longitude, longitudes)) +
           " and leaves part of the sphere out; give a global raster in degrees";
  const std::optional<Eigen::Vector3d> place = place_outside(cover, region);
  if (!place)
    return {};
  const auto [east, north] = base_detail::lonlat_of({place->x(), place->y(), place->z()});
  return extent(longitude, longitudes) + ", " + extent(latitude, latitudes) +
         ", and leaves out the place " + shortly(east) + " " + shortly(north) +
         " of the region; give a raster in degrees that covers it";
}

} // namespace density_detail

void require_covering(const CellWidth& cell_width, const Surface& surface) {
  domain_detail::require_sphere(surface, widths_are);
  const WidthField field(cell_width); // throws if it is ill-formed
  const std::string problem = density_detail::uncovered(cell_width.longitudes, cell_width.latitudes,
                                                        surface, "longitude", "latitude");
  base_detail::require(problem.empty(), "cell width: " + problem);
}

Gradient largest_gradient(const CellWidth& cell_width, double radius_km) {
  require_radius(radius_km);
  const WidthField field(cell_width);
  std::vector<Corner> rows(static_cast<std::size_t>(field.latitudes().intervals()));
  base_detail::for_each_task(field.latitudes().intervals(), [&](std::int64_t j) {
    rows[static_cast<std::size_t>(j)] = steepest_of_row(field, j, 1 / radius_km);
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
