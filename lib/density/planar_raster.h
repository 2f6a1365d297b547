// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/cell_width_field.h"
#include "density/room.h"

#include <calotte/planar_raster.h>

namespace calotte::density_detail {

/// Values on a grid, which finds intervals in constant time.
struct PlanarField {
  Axis x, y;
  DoubleMatrix values;

  /// Bilinear; outside that of the nearest point of the grid.
  double at(double px, double py) const {
    const std::int64_t i = x.interval(px), j = y.interval(py);
    const double u = x.fraction(i, px), v = y.fraction(j, py);
    const double low = values(i, j) + u * (values(i + 1, j) - values(i, j)),
                 high = values(i, j + 1) + u * (values(i + 1, j + 1) - values(i, j + 1));
    return low + v * (high - low);
  }
};

/// \throws Error invalid_argument as require_widths().
PlanarField field_of(const PlanarCellWidth& widths);

/// A grid over a rectangle without values, of at most so many nodes.
/// \param size of the rectangle; > 0. \param step largest distance of its nodes, > 0, which grows
///        where these would be more.
PlanarCellWidth grid_over(const Eigen::Vector2d& low, const Eigen::Vector2d& size, double step,
                          double most_nodes);

/// \throws Error invalid_argument unless it meets the conditions of PlanarCellWidth.
void require_widths(const PlanarCellWidth& widths);

} // namespace calotte::density_detail
