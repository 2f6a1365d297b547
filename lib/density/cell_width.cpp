// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/widths.h>

#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "density/raster_field.h"
#include "density/sampled_widths.h"
#include "density/sampling.h"
#include "density/tile_integral.h"
#include "domain/spherical_outline.h"
#include "domain/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace calotte {
namespace {

using base_detail::require;
using density_detail::RasterField;
using density_detail::require_kind;
using density_detail::require_radius;
using density_detail::SampledWidths;
using density_detail::WidthTiles;

/// Integrates 1/h^2 over the boxes between rows j and j + 1 of the unit sphere. Along a parallel h
/// is linear in a box: the integral is the box's length over the product of the end values. Across
/// parallels, Gauss' rule integrates in the sine of the latitude, in which areas are uniform.
/// \tparam Field a RasterField, or a tile.
template <class Field> double integral_of_row(const Field& field, std::int64_t j) {
  constexpr std::array nodes{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                             0.8611363115940526};
  constexpr std::array weights{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                               0.3478548451374538};
  const double south = field.sine(j), half = 0.5 * (field.sine(j + 1) - south);
  double sum = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double latitude = base_detail::arc_sine(south + half * (1 + nodes[k]));
    const double v = field.y().fraction(j, latitude);
    const auto at = [&](std::int64_t i) {
      return field.value(i, j) + v * (field.value(i, j + 1) - field.value(i, j));
    };
    double along = 0;
    for (std::int64_t i = 0; i < field.x().intervals(); ++i)
      along += (field.x()[i + 1] - field.x()[i]) / (at(i) * at(i + 1));
    sum += weights[k] * half * along;
  }
  return sum;
}

struct Corner {
  double square = -1;  ///< of the slope, per radian
  double x = 0, y = 0; ///< radians
};

/// The distance from the end of an interval to the middle of a cell, as a part of the interval:
/// half of the cell's width, at most 1/2.
double middle_of_cell(double width, double interval) {
  return std::min(0.5, 0.5 * width / interval);
}

/// Finds the steepest corner of the boxes between rows j and j + 1. In a box dh/dlat is linear in
/// longitude and dh/dlon is linear in latitude: the mean over the cell in a corner is the value at
/// the cell's middle. \param radians of a width of 1.
template <class Field> Corner steepest_of_row(const Field& field, std::int64_t j, double radians) {
  const double height = field.y()[j + 1] - field.y()[j];
  Corner steepest;
  for (std::int64_t i = 0; i < field.x().intervals(); ++i) {
    const double length = field.x()[i + 1] - field.x()[i];
    const double south = field.value(i + 1, j) - field.value(i, j),
                 north = field.value(i + 1, j + 1) - field.value(i, j + 1),
                 west = field.value(i, j + 1) - field.value(i, j),
                 east = field.value(i + 1, j + 1) - field.value(i + 1, j);
    for (const std::int64_t row : {j, j + 1})
      for (const std::int64_t column : {i, i + 1}) {
        const double width = field.value(column, row) * radians;
        const double up = middle_of_cell(width, height), v = row == j ? up : 1 - up;
        const double cosine = std::cos(field.y()[j] + v * height);
        const double along = middle_of_cell(width, length * cosine),
                     u = column == i ? along : 1 - along;
        const double dx = (south + v * (north - south)) / (length * cosine),
                     dy = (west + u * (east - west)) / height;
        if (const double square = dx * dx + dy * dy; square > steepest.square)
          steepest = {square, field.x()[column], field.y()[row]};
      }
  }
  return steepest;
}

/// Calls of_row(field, j) for the rows of boxes and joins the results in a fixed order: row by row
/// in a raster; in tiles, the rows of each tile are joined first.
template <class Value, class OfRow, class Join>
Value joined_rows(const RasterField& field, const Value& none, const OfRow& of_row,
                  const Join& join) {
  std::vector<Value> rows(static_cast<std::size_t>(field.y().intervals()));
  base_detail::for_each_task(std::ssize(rows), [&](std::int64_t j) {
    rows[static_cast<std::size_t>(j)] = of_row(field, j);
  });
  return std::accumulate(rows.begin(), rows.end(), none, join);
}

template <class Value, class OfRow, class Join>
Value joined_rows(const WidthTiles& tiles, const Value& none, const OfRow& of_row,
                  const Join& join) {
  std::vector<Value> all(static_cast<std::size_t>(tiles.size()), none);
  base_detail::for_each_task(tiles.size(), [&](std::int64_t k) {
    if (tiles.lies_outside(k))
      return;
    const WidthTiles::Tile tile = tiles[k];
    Value& value = all[static_cast<std::size_t>(k)];
    for (std::int64_t j = 0; j < tile.y().intervals(); ++j)
      value = join(value, of_row(tile, j));
  });
  return std::accumulate(all.begin(), all.end(), none, join);
}

} // namespace

namespace density_detail {

void require_kind(bool of_plane, const Surface& surface) {
  if (of_plane)
    domain_detail::require_plane(surface, "cell widths by x and y are");
  else
    domain_detail::require_sphere(surface, "cell widths by longitude and latitude are");
}

void require_radius(double radius_km) {
  require(radius_km > 0 && std::isfinite(radius_km),
          "the sphere's radius must be positive; give it in km");
}

} // namespace density_detail

WidthField::WidthField(const Raster& widths)
    : WidthField(std::make_shared<const SampledWidths>(widths)) {}
WidthField::WidthField(std::shared_ptr<const SampledWidths> widths) : sampled_(std::move(widths)) {}

double WidthField::least() const { return sampled_->least(); }
double WidthField::greatest() const { return sampled_->greatest(); }
std::int64_t WidthField::nodes() const { return sampled_->count(); }
double WidthField::apart() const { return sampled_->apart(); }
bool WidthField::of_plane() const { return sampled_->of_plane(); }

DoubleVector evaluate(const WidthField& widths, const PointsRef& points) {
  return density_detail::evaluate_field(*widths.sampled(), points);
}

Density density_of(const WidthField& widths) {
  Density density;
  if (widths.least() == widths.greatest())
    return density;
  density.kind = Density::Kind::widths;
  density.widths = widths.sampled();
  return density;
}

Density interpolated_density(const Raster& density) {
  density_detail::require_values(density, "density", density_detail::not_negative);
  Density interpolated;
  interpolated.kind = Density::Kind::callable;
  interpolated.callable = [field = std::make_shared<const RasterField>(density)](
                              const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    density_detail::evaluate_block(*field, x, rho);
  };
  return interpolated;
}

Raster widths_of_density(const Raster& density) {
  density_detail::require_values(density, "density", density_detail::positive_and_finite);
  Raster widths = density;
  widths.values = widths.values.unaryExpr([](double rho) { return 1 / std::sqrt(std::sqrt(rho)); });
  widths.values /= widths.values.minCoeff();
  return widths;
}

double implied_cells(const WidthField& widths, const Surface& surface, double radius_km) {
  require_kind(widths.of_plane(), surface);
  require_radius(radius_km);
  const double unit = widths.of_plane() ? 1 : radius_km;
  const auto& nodes = widths.sampled()->nodes();
  const auto cells = [&](double integral) {
    return 2 / std::numbers::sqrt3 * unit * unit * integral;
  };
  if (!widths.of_plane() && !surface.is_bounded()) {
    const auto of_row = [](const auto& part, std::int64_t j) { return integral_of_row(part, j); };
    return cells(std::visit(
        [&](const auto& field) { return joined_rows(field, 0.0, of_row, std::plus<>()); }, nodes));
  }
  if (const auto* const tiles = std::get_if<WidthTiles>(&nodes))
    return cells(density_detail::integral_in(*tiles, surface));
  constexpr std::int64_t samples = 1 << 18;
  const Points3 points = density_detail::draw(samples, Density{}, surface, 1);
  const double mean = evaluate(widths, points).array().square().inverse().mean();
  return cells(surface.area() * mean);
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

  bool contains(const Eigen::Vector3d& x) const {
    const auto [longitude, latitude] = base_detail::lonlat_of({x.x(), x.y(), x.z()});
    if ((latitude < south && !to_south) || (latitude > north && !to_north))
      return false;
    const double east = longitude - west;
    return around || east - 360 * std::floor(east / 360) <= length;
  }
};

Cover make_cover(const Raster& raster) {
  const DoubleVector &longitudes = raster.x, &latitudes = raster.y;
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

/// Finds a point of the region that is not covered. It tests samples of the boundary, then points
/// outside the cover, in case the region contains a whole part that is not covered.
std::optional<Eigen::Vector3d> point_outside(const Cover& cover, const Surface& region) {
  constexpr double apart = 1e-3; // radians
  for (const Points3 ring : region.rings())
    for (Eigen::Index i = 0; i < ring.cols(); ++i) {
      const Eigen::Vector3d from = ring.col(i).normalized(),
                            to = ring.col((i + 1) % ring.cols()).normalized();
      const auto parts = static_cast<int>((to - from).norm() / apart) + 1;
      for (int k = 0; k < parts; ++k) {
        const Eigen::Vector3d at = from + (to - from) * (double(k) / parts);
        if (!cover.contains(at))
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

std::string extent(const std::string& name, const DoubleVector& nodes) {
  return message("{} runs from {} to {}", name, nodes[0], nodes[nodes.size() - 1]);
}

std::string leaves_out(const Raster& raster, const std::string& x, const std::string& y,
                       const Eigen::Vector3d& point, const char* of) {
  const auto [east, north] = base_detail::lonlat_of({point.x(), point.y(), point.z()});
  return message("{}, {}, and leaves out the place {} {}{}; "
                 "give a raster in degrees that covers it",
                 extent(x, raster.x), extent(y, raster.y), east, north, of);
}

std::string uncovered_sphere(const Raster& raster, const Surface& region, const std::string& x,
                             const std::string& y) {
  const Cover cover = make_cover(raster);
  if (cover.whole())
    return {};
  if (!region.is_bounded())
    return message("{} and leaves part of the sphere out; give a global raster in degrees",
                   cover.around ? extent(y, raster.y) : extent(x, raster.x));
  const std::optional<Eigen::Vector3d> point = point_outside(cover, region);
  return point ? leaves_out(raster, x, y, *point, " of the region") : std::string();
}

std::string uncovered_plane(const Raster& raster, const Surface& plane, const std::string& x,
                            const std::string& y) {
  domain_detail::require_finite_plane(plane);
  const Surface::Rings& rings = plane.rings();
  Eigen::Vector2d low(0, 0), high = plane.period();
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Eigen::Vector2d least = rings[i].rowwise().minCoeff(),
                          most = rings[i].rowwise().maxCoeff();
    low = i == 0 ? least : Eigen::Vector2d(low.cwiseMin(least));
    high = i == 0 ? most : Eigen::Vector2d(high.cwiseMax(most));
  }
  const auto beyond = [&](const DoubleVector& nodes, const std::string& name,
                          int k) -> std::string {
    const double slack = 0.5 * widest_step(nodes);
    if (low[k] >= nodes[0] - slack && high[k] <= nodes[nodes.size() - 1] + slack)
      return {};
    return message("{}, but the domain from {} to {}; give a raster that covers the domain",
                   extent(name, nodes), low[k], high[k]);
  };
  const std::string of_x = beyond(raster.x, x, 0);
  return of_x.empty() ? beyond(raster.y, y, 1) : of_x;
}

} // namespace

std::string uncovered(const Raster& raster, const Surface& surface, const std::string& x,
                      const std::string& y) {
  return raster.of_plane ? uncovered_plane(raster, surface, x, y)
                         : uncovered_sphere(raster, surface, x, y);
}

std::string uncovered(const Raster& raster, const Points3& points, const std::string& x,
                      const std::string& y) {
  const Cover cover = make_cover(raster);
  for (const auto& point : points.colwise())
    if (!cover.contains(point))
      return leaves_out(raster, x, y, point, "");
  return {};
}

} // namespace density_detail

void require_covering(const Raster& widths, const Surface& surface) {
  require_kind(widths.of_plane, surface);
  density_detail::require_widths(widths);
  const std::string problem =
      widths.of_plane ? density_detail::uncovered(widths, surface, "x", "y")
                      : density_detail::uncovered(widths, surface, "longitude", "latitude");
  require(problem.empty(), "cell width: {}", problem);
}

WidthGradient largest_gradient(const WidthField& widths, double radius_km) {
  require_kind(widths.of_plane(), {});
  require_radius(radius_km);
  const auto of_row = [&](const auto& part, std::int64_t j) {
    return steepest_of_row(part, j, 1 / radius_km);
  };
  const auto steeper = [](const Corner& a, const Corner& b) { return b.square > a.square ? b : a; };
  const Corner steepest =
      std::visit([&](const auto& nodes) { return joined_rows(nodes, Corner(), of_row, steeper); },
                 widths.sampled()->nodes());
  constexpr double degrees = 180 / std::numbers::pi;
  const double longitude = steepest.x * degrees;
  return {std::sqrt(std::max(0.0, steepest.square)) / radius_km,
          longitude < 180 ? longitude : longitude - 360, steepest.y * degrees};
}

} // namespace calotte
