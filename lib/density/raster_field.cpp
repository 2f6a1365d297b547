// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/raster_field.h"

#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/spherical_angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace calotte::density_detail {
namespace {

constexpr double radians = std::numbers::pi / 180;

/// Requires ascending values. \param nearest minimum distance of two values: slopes overflow where
/// they are closer.
void require_ascending(const DoubleVector& values, const std::string& name, const std::string& axis,
                       double nearest) {
  require(values.size() >= 2, "{}: fewer than 2 {}; give a grid that covers the domain", name,
          axis);
  for (Eigen::Index i = 0; i < values.size(); ++i)
    require(std::isfinite(values[i]) &&
                (i == 0 || (values[i] > values[i - 1] && values[i] - values[i - 1] >= nearest)),
            "{}: {} {} is not finite and above the one before{}; sort them", name, axis, i,
            nearest > 0 ? " by 1e-9 degrees" : "");
}

/// The mean of a row, exact if all values are equal.
double mean(const Raster& raster, Eigen::Index row) {
  const double first = raster.values(0, row);
  double sum = 0;
  for (Eigen::Index i = 0; i < raster.values.rows(); ++i)
    sum += raster.values(i, row) - first;
  return first + sum / static_cast<double>(raster.values.rows());
}

CALOTTE_VECTOR_WIDTHS
void to_angles(const double* x, const double* y, const double* z, std::size_t count,
               double* longitudes, double* latitudes) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t j = 0; j < count; ++j) {
    longitudes[j] = longitude_of(x[j], y[j]);
    latitudes[j] = latitude_of(x[j], y[j], z[j]);
  }
}

} // namespace

// ---- Axis

Axis::Axis(std::vector<double> values) : values_(std::move(values)) {
  const std::int64_t bins = 2 * intervals();
  bins_per_unit_ = static_cast<double>(bins) / (values_.back() - values_.front());
  std::int64_t i = 0;
  for (std::int64_t bin = 0; bin < bins; ++bin) {
    const double start = values_.front() + static_cast<double>(bin) / bins_per_unit_;
    while (i + 1 < intervals() && values_[static_cast<std::size_t>(i) + 1] <= start)
      ++i;
    first_.push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t k = 0; k + 1 < values_.size(); ++k)
    inverse_steps_.push_back(1 / (values_[k + 1] - values_[k]));
}

std::int64_t Axis::interval(double x) const {
  const auto last_bin = static_cast<double>(first_.size() - 1);
  const double bin = std::clamp((x - values_.front()) * bins_per_unit_, 0.0, last_bin);
  std::int64_t i = first_[static_cast<std::size_t>(bin)];
  while (i > 0 && (*this)[i] > x) // the bin's start was rounded
    --i;
  while (i + 1 < intervals() && (*this)[i + 1] <= x)
    ++i;
  return i;
}

double Axis::fraction(std::int64_t i, double x) const {
  return std::clamp((x - (*this)[i]) * inverse_steps_[static_cast<std::size_t>(i)], 0.0, 1.0);
}

// ---- Conditions

void require_raster(const Raster& raster, const std::string& name) {
  const DoubleVector &x = raster.x, &y = raster.y;
  const double nearest = raster.of_plane ? 0 : 1e-9; // degrees
  require_ascending(x, name, raster.of_plane ? "x" : "longitudes", nearest);
  require_ascending(y, name, raster.of_plane ? "y" : "latitudes", nearest);
  require(raster.of_plane || x[x.size() - 1] < x[0] + 360,
          "{}: the last longitude is not below the first + 360; remove the repeated longitudes",
          name);
  require(raster.of_plane || (y[0] >= -90 && y[y.size() - 1] <= 90),
          "{}: latitudes outside -90 to 90; give degrees north", name);
  require(raster.values.rows() == x.size() && raster.values.cols() == y.size(),
          "{}: the values are not {}; give one for each node", name,
          raster.of_plane ? "x by y" : "longitudes x latitudes");
}

void require_values(const Raster& raster, const std::string& name, const ValueLaw& law) {
  require_raster(raster, name);
  for (Eigen::Index j = 0; j < raster.y.size(); ++j)
    for (Eigen::Index i = 0; i < raster.x.size(); ++i)
      require(law.holds(raster.values(i, j)), "{}: value ({}, {}) is not {}; correct it", name, i,
              j, law.name);
}

void require_widths(const Raster& widths) {
  require_values(widths, "cell width", positive_and_finite);
  require_ratio(widths.values.maxCoeff(), widths.values.minCoeff());
}

void require_positive(double value, const char* name, const char* rules) {
  require(positive_and_finite.holds(value), "the {} of a rule of {}, {}, is not positive; give one",
          name, rules, value);
}

void require_ratio(double most, double least) {
  require(most <= 1e30 * least,
          "cell width: the widths differ by more than 1e30; give them in one unit");
}

// ---- RasterField

RasterField::RasterField(const Raster& raster) : of_plane_(raster.of_plane) {
  require_raster(raster, "raster");
  const Eigen::Index last = raster.y.size() - 1;
  if (of_plane_) {
    x_ = Axis({raster.x.begin(), raster.x.end()});
    y_ = Axis({raster.y.begin(), raster.y.end()});
    values_.assign(raster.values.data(), raster.values.data() + raster.values.size());
    return;
  }
  const double shift = 360 * std::floor((raster.x[0] + 180) / 360);
  std::vector<double> columns, rows;
  for (const double longitude : raster.x)
    columns.push_back((longitude - shift) * radians);
  columns.push_back((raster.x[0] - shift + 360) * radians);

  const auto add = [&](Eigen::Index row, double latitude) {
    rows.push_back(latitude * radians);
    add_row(raster, row, latitude);
  };
  if (raster.y[0] > -90)
    add(0, -90);
  for (Eigen::Index row = 0; row <= last; ++row)
    add(row, raster.y[row]);
  if (raster.y[last] < 90)
    add(last, 90);
  table_ = WidthTable::make(columns, rows, values_);
  x_ = Axis(std::move(columns));
  y_ = Axis(std::move(rows));
}

void RasterField::add_row(const Raster& raster, Eigen::Index row, double latitude) {
  const Vec3 meridian = from_lonlat(0, latitude);
  cosines_.push_back(meridian.x);
  sines_.push_back(meridian.z);
  const std::size_t start = values_.size();
  if (std::abs(latitude) == 90) {
    values_.resize(start + static_cast<std::size_t>(raster.values.rows()) + 1, mean(raster, row));
    return;
  }
  const auto column = raster.values.col(row);
  values_.insert(values_.end(), column.begin(), column.end());
  values_.push_back(column[0]);
}

double RasterField::between(double x, double y) const {
  const std::int64_t i = x_.interval(x), j = y_.interval(y);
  const double u = x_.fraction(i, x), v = y_.fraction(j, y);
  const double* const low = &values_[static_cast<std::size_t>(j * (x_.intervals() + 1) + i)];
  const double* const high = low + x_.intervals() + 1;
  const double south = low[0] + u * (low[1] - low[0]), north = high[0] + u * (high[1] - high[0]);
  return south + v * (north - south);
}

void RasterField::operator()(const double* x, const double* y, const double* z, std::size_t count,
                             double* values) const {
  if (table_) {
    (*table_)(x, y, z, count, values);
    return;
  }
  if (of_plane_) {
    for (std::size_t k = 0; k < count; ++k)
      values[k] = between(x[k], y[k]);
    return;
  }
  constexpr std::size_t most = 128;
  constexpr double turn = 2 * std::numbers::pi;
  std::array<double, most> longitudes, latitudes;
  for (std::size_t begin = 0; begin < count; begin += most) {
    const std::size_t size = std::min(most, count - begin);
    to_angles(x + begin, y + begin, z + begin, size, longitudes.data(), latitudes.data());
    for (std::size_t k = 0; k < size; ++k) {
      const double longitude = longitudes[k];
      values[begin + k] = between(longitude < x_[0] ? longitude + turn : longitude, latitudes[k]);
    }
  }
}

// ---- Grids

Raster regular_grid(double step) {
  const auto rows = static_cast<Eigen::Index>(std::ceil(180 / step)), columns = 2 * rows;
  Raster grid;
  grid.x.resize(columns);
  for (Eigen::Index i = 0; i < columns; ++i)
    grid.x[i] = static_cast<double>(360 * i) / static_cast<double>(columns) - 180;
  grid.y.resize(rows + 1);
  for (Eigen::Index j = 0; j <= rows; ++j)
    grid.y[j] = static_cast<double>(180 * j) / static_cast<double>(rows) - 90;
  grid.values.resize(columns, rows + 1);
  return grid;
}

Raster grid_over(const Eigen::Vector2d& low, const Eigen::Vector2d& size, double step,
                 double most_nodes) {
  const auto intervals = [&](int k) { return std::max(1.0, std::ceil(size[k] / step)); };
  while ((intervals(0) + 1) * (intervals(1) + 1) > most_nodes)
    step *= 1.25;
  const auto axis = [&](int k) {
    const auto nodes = static_cast<Eigen::Index>(intervals(k)) + 1;
    return DoubleVector(DoubleVector::LinSpaced(nodes, low[k], low[k] + size[k]));
  };
  Raster grid{axis(0), axis(1), {}, true};
  grid.values.resize(grid.x.size(), grid.y.size());
  return grid;
}

} // namespace calotte::density_detail

namespace calotte {

DoubleVector evaluate(const Raster& raster, const PointsRef& points) {
  return density_detail::evaluate_field(density_detail::RasterField(raster), points);
}

} // namespace calotte
