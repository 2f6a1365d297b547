// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/cell_width_field.h"

#include "base/lonlat.h"
#include "base/spherical_angles.h"

#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace calotte::density_detail {
namespace {

constexpr double radians = std::numbers::pi / 180;

[[noreturn]] void refuse_cell_width(const std::string& problem) {
  throw Error(ErrorCode::invalid_argument, "cell width: " + problem);
}

constexpr double nearest = 1e-9; // degrees between nodes; slopes overflow where they are closer

void require_ascending(const DoubleVector& values, const std::string& name) {
  if (values.size() < 2)
    refuse_cell_width("fewer than 2 " + name + "; give a grid that covers the sphere");
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) || (i > 0 && !(values[i] - values[i - 1] >= nearest)))
      refuse_cell_width(name + " " + std::to_string(i) +
                        " is not finite and above the one before by 1e-9 degrees; sort them");
}

void require(const CellWidth& cell_width) {
  const DoubleVector &longitudes = cell_width.longitudes, &latitudes = cell_width.latitudes;
  require_ascending(longitudes, "longitudes");
  require_ascending(latitudes, "latitudes");
  if (!(longitudes[longitudes.size() - 1] < longitudes[0] + 360))
    refuse_cell_width(
        "the last longitude is not below the first + 360; remove the repeated longitudes");
  if (latitudes[0] < -90 || latitudes[latitudes.size() - 1] > 90)
    refuse_cell_width("latitudes outside -90 to 90; give degrees north");
  if (cell_width.widths.rows() != longitudes.size() || cell_width.widths.cols() != latitudes.size())
    refuse_cell_width("the widths are not longitudes x latitudes; give one for each node");
  for (Eigen::Index j = 0; j < latitudes.size(); ++j)
    for (Eigen::Index i = 0; i < longitudes.size(); ++i)
      if (!(cell_width.widths(i, j) > 0) || !std::isfinite(cell_width.widths(i, j)))
        refuse_cell_width("widths (" + std::to_string(i) + ", " + std::to_string(j) +
                          ") is not positive and finite; correct it");
  if (cell_width.widths.maxCoeff() > 1e30 * cell_width.widths.minCoeff())
    refuse_cell_width("the widths differ by more than 1e30; give them in one unit");
}

/// The mean of a row, exact if all values are equal.
double mean(const CellWidth& cell_width, Eigen::Index row) {
  const double first = cell_width.widths(0, row);
  double sum = 0;
  for (Eigen::Index i = 0; i < cell_width.widths.rows(); ++i)
    sum += cell_width.widths(i, row) - first;
  return first + sum / static_cast<double>(cell_width.widths.rows());
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

// ---- WidthField

WidthField::WidthField(const CellWidth& cell_width) {
  require(cell_width);
  const DoubleVector &longitudes = cell_width.longitudes, &latitudes = cell_width.latitudes;
  const double shift = 360 * std::floor((longitudes[0] + 180) / 360);
  std::vector<double> columns;
  for (const double longitude : longitudes)
    columns.push_back((longitude - shift) * radians);
  columns.push_back((longitudes[0] - shift + 360) * radians);

  std::vector<double> rows;
  const auto add = [&](Eigen::Index row, double latitude) {
    rows.push_back(latitude * radians);
    add_row(cell_width, row, latitude);
  };
  const Eigen::Index last = latitudes.size() - 1;
  if (latitudes[0] > -90)
    add(0, -90);
  for (Eigen::Index row = 0; row <= last; ++row)
    add(row, latitudes[row]);
  if (latitudes[last] < 90)
    add(last, 90);
  table_ = WidthTable::make(columns, rows, widths_);
  longitudes_ = Axis(std::move(columns));
  latitudes_ = Axis(std::move(rows));
  least_ = cell_width.widths.minCoeff();
}

void WidthField::add_row(const CellWidth& cell_width, Eigen::Index row, double latitude) {
  const Vec3 meridian = from_lonlat(0, latitude);
  cosines_.push_back(meridian.x);
  sines_.push_back(meridian.z);
  const std::size_t start = widths_.size();
  if (std::abs(latitude) == 90) {
    widths_.resize(start + static_cast<std::size_t>(cell_width.widths.rows()) + 1,
                   mean(cell_width, row));
    return;
  }
  const auto column = cell_width.widths.col(row);
  widths_.insert(widths_.end(), column.begin(), column.end());
  widths_.push_back(column[0]);
}

double WidthField::interpolate(double longitude, double latitude) const {
  constexpr double turn = 2 * std::numbers::pi;
  const double east = longitude < longitudes_[0] ? longitude + turn : longitude;
  const std::int64_t i = longitudes_.interval(east), j = latitudes_.interval(latitude);
  const double u = longitudes_.fraction(i, east), v = latitudes_.fraction(j, latitude);
  const double* const low =
      &widths_[static_cast<std::size_t>(j * (longitudes_.intervals() + 1) + i)];
  const double* const high = low + longitudes_.intervals() + 1;
  const double south = low[0] + u * (low[1] - low[0]), north = high[0] + u * (high[1] - high[0]);
  return south + v * (north - south);
}

void WidthField::operator()(const double* x, const double* y, const double* z, std::size_t count,
                            double* widths) const {
  if (table_) {
    (*table_)(x, y, z, count, widths);
    return;
  }
  constexpr std::size_t most = 128;
  std::array<double, most> longitudes, latitudes;
  for (std::size_t begin = 0; begin < count; begin += most) {
    const std::size_t size = std::min(most, count - begin);
    to_angles(x + begin, y + begin, z + begin, size, longitudes.data(), latitudes.data());
    for (std::size_t k = 0; k < size; ++k)
      widths[begin + k] = interpolate(longitudes[k], latitudes[k]);
  }
}

CellWidth regular_grid(double step) {
  const auto rows = static_cast<Eigen::Index>(std::ceil(180 / step)), columns = 2 * rows;
  CellWidth grid;
  grid.longitudes.resize(columns);
  for (Eigen::Index i = 0; i < columns; ++i)
    grid.longitudes[i] = static_cast<double>(360 * i) / static_cast<double>(columns) - 180;
  grid.latitudes.resize(rows + 1);
  for (Eigen::Index j = 0; j <= rows; ++j)
    grid.latitudes[j] = static_cast<double>(180 * j) / static_cast<double>(rows) - 90;
  grid.widths.resize(columns, rows + 1);
  return grid;
}

} // namespace calotte::density_detail
