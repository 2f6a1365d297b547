// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vector_loops.h"
#include "density/room.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace calotte::density_detail {

/// Cell widths on a regular grid of longitudes and latitudes that covers the sphere, for vector
/// code: intervals follow from one product, and angles from polynomials, with an error of 3e-14
/// radians.
class WidthTable {
public:
  /// Empty if the steps of an axis differ by more than 1e-9 of a step, except for those from the
  /// outer rows to the poles.
  /// \param longitudes radians, ascending, from the first to the first + 2 pi.
  /// \param latitudes radians, ascending, from pole to pole.
  /// \param widths by row, one for each longitude.
  static std::optional<WidthTable> make(const std::vector<double>& longitudes,
                                        const std::vector<double>& latitudes,
                                        const std::vector<double>& widths);

  /// Widths at unit vectors given by their coordinates. The bits of each depend on its vector
  /// alone.
  void operator()(const double* x, const double* y, const double* z, std::size_t count,
                  double* widths) const;

  /// Axes of equal steps.
  struct Grid {
    double west, inverse_dx, south, inverse_dy; ///< radians
    std::int32_t columns, rows;                 ///< intervals
  };

private:
  Grid grid_{};
  /// Widths row by row, with the rows beyond the poles.
  std::vector<double> widths_;
};

/// The positions of points on a grid.
struct GridCells {
  static constexpr std::size_t size = 128;
  std::array<std::int32_t, size> corner; ///< of the south-west corner: row * (columns + 1) + column
  std::array<double, size> u, v;         ///< within the cell, 0 to 1
};

/// Splits a position on an axis, in steps, into its interval and the fraction within it.
CALOTTE_INLINE void split_position(double position, std::int32_t intervals, std::int32_t& interval,
                                   double& fraction) {
  const double low = position > 0 ? position : 0;
  const double inside = low < intervals ? low : intervals;
  const auto floor = static_cast<std::int32_t>(inside);
  interval = floor < intervals ? floor : intervals - 1;
  fraction = inside - interval;
}

/// The cells of at most GridCells::size unit vectors.
void find_cells(const WidthTable::Grid& grid, const double* x, const double* y, const double* z,
                std::size_t count, GridCells& out);

} // namespace calotte::density_detail
