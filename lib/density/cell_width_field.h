// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"
#include "density/width_table.h"

#include <calotte/cell_width.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace calotte::density_detail {

/// Ascending values in which intervals are found in constant time.
class Axis {
public:
  Axis() = default;
  /// At least two values.
  explicit Axis(std::vector<double> values);

  /// The last i with values[i] <= x, clamped to the first and last interval.
  std::int64_t interval(double x) const;

  /// The relative position of x in interval i: 0 at its start, 1 at its end, clamped.
  double fraction(std::int64_t i, double x) const;

  double operator[](std::int64_t i) const { return values_[static_cast<std::size_t>(i)]; }
  std::int64_t intervals() const { return static_cast<std::int64_t>(values_.size()) - 1; }

private:
  std::vector<double> values_, inverse_steps_;
  std::vector<std::int32_t> first_; ///< by bin: the interval that contains the start of the bin
  double bins_per_unit_ = 0;
};

/// A cell width prepared for repeated evaluation: the first column is repeated at the end, and the
/// rows at the poles have one value each.
class WidthField {
public:
  /// \throws Error invalid_argument if it violates the conditions of CellWidth.
  explicit WidthField(const CellWidth& cell_width);

  /// Widths at unit vectors given by their coordinates. The bits of each width depend on its vector
  /// alone.
  void operator()(const double* x, const double* y, const double* z, std::size_t count,
                  double* widths) const;

  const Axis& longitudes() const { return longitudes_; } ///< radians; the first from -pi to pi
  const Axis& latitudes() const { return latitudes_; }   ///< radians, from pole to pole
  double width(std::int64_t i, std::int64_t j) const {
    return widths_[static_cast<std::size_t>(j * (longitudes_.intervals() + 1) + i)];
  }
  double least() const { return least_; }

  /// Cosine of the latitude of a row, as from_lonlat() computes it: the same bits on every machine.
  double cosine(std::int64_t j) const { return cosines_[static_cast<std::size_t>(j)]; }
  double sine(std::int64_t j) const { return sines_[static_cast<std::size_t>(j)]; }

private:
  double interpolate(double longitude, double latitude) const;
  void add_row(const CellWidth& cell_width, Eigen::Index row, double latitude);

  Axis longitudes_, latitudes_;
  std::optional<WidthTable> table_; ///< of a regular grid
  std::vector<double> widths_;      ///< row by row
  std::vector<double> cosines_, sines_;
  double least_ = 0; ///< of the nodes given
};

/// \throws Error invalid_argument unless a radius is > 0 and finite.
void require_radius(double radius_km);

/// Why nodes do not cover a region, see require_covering(); empty if they do.
/// \param longitude, latitude names of the coordinates in the message.
std::string uncovered(const DoubleVector& longitudes, const DoubleVector& latitudes,
                      const Surface& region, const std::string& longitude,
                      const std::string& latitude);

/// The callable of a density (h_min/h)^4. DensityEvaluator calls the second operator.
class WidthDensity {
public:
  explicit WidthDensity(const CellWidth& cell_width)
      : field_(std::make_shared<const WidthField>(cell_width)) {}

  void operator()(const Eigen::Ref<const Points3>& points, Eigen::Ref<Eigen::VectorXd> rho) const;
  void operator()(const double* x, const double* y, const double* z, std::size_t count,
                  double* rho) const;

private:
  std::shared_ptr<const WidthField> field_;
};

/// The regular grid, poles included, with the largest step of at most `step` degrees that divides
/// 180. The widths are not set.
CellWidth regular_grid(double step);

} // namespace calotte::density_detail
