// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

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
  /// By row, the rows beyond the poles included.
  std::vector<double> widths_;
};

} // namespace calotte::density_detail
