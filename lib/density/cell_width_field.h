// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <calotte/cell_width.h>

#include <cstdint>
#include <vector>

namespace calotte::density_detail {

/// Ascending values in which intervals are found in constant time.
class Axis {
public:
  Axis() = default;
  /// At least two values.
  explicit Axis(std::vector<double> values);

  /// The last i with values[i] <= x; the first or the last interval where there is none.
  std::int64_t interval(double x) const;

  /// Where x stands in interval i: 0 at its start, 1 at its end and beyond.
  double fraction(std::int64_t i, double x) const;

  double operator[](std::int64_t i) const { return values_[static_cast<std::size_t>(i)]; }
  std::int64_t intervals() const { return static_cast<std::int64_t>(values_.size()) - 1; }

private:
  std::vector<double> values_, inverse_steps_;
  std::vector<std::int32_t> first_; ///< by bin: the interval that its start lies in
  double bins_per_unit_ = 0;
};

/// A cell width made ready to be evaluated many times: the first column stands again at the end,
/// and a row at either pole has one value.
class WidthField {
public:
  /// \throws Error bad_option where it is not as CellWidth says.
  explicit WidthField(const CellWidth& cell_width);

  /// Widths at unit vectors given by their coordinates: of each alone, in any company.
  void operator()(const double* x, const double* y, const double* z, std::size_t count,
                  double* widths) const;

  const Axis& longitudes() const { return longitudes_; } ///< radians; the first from -pi to pi
  const Axis& latitudes() const { return latitudes_; }   ///< radians, from pole to pole
  double width(std::int64_t i, std::int64_t j) const {
    return widths_[static_cast<std::size_t>(j * (longitudes_.intervals() + 1) + i)];
  }
  double least() const { return least_; }

  /// Of a row: from_lonlat's, the same bits on every machine.
  double cosine(std::int64_t j) const { return cosines_[static_cast<std::size_t>(j)]; }
  double sine(std::int64_t j) const { return sines_[static_cast<std::size_t>(j)]; }

private:
  double interpolate(double longitude, double latitude) const;
  void add_row(const CellWidth& cell_width, Eigen::Index row, double latitude);

  Axis longitudes_, latitudes_;
  std::vector<double> widths_; ///< row by row
  std::vector<double> cosines_, sines_;
  double least_ = 0; ///< of the nodes given
};

/// The regular grid whose steps are the largest of at most so many degrees that divide the
/// hemisphere, poles included, with widths yet to be filled in.
CellWidth regular_grid(double step);

} // namespace calotte::density_detail
