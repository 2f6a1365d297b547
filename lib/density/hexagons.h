// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>

/// Regular hexagons, the cells of an ideal grid.
namespace calotte::density_detail {

/// The integral of |x - c|^2 over a regular hexagon of area 1, c its centre: 5/(18 sqrt 3).
/// (Gersho, IEEE Trans. Inf. Theory 25, 1979.)
inline constexpr double hexagon_energy = 5 / (18 * std::numbers::sqrt3);

/// The distance of the centres of hexagons of that area.
inline double hexagon_width(double area) { return std::sqrt(2 / std::numbers::sqrt3 * area); }

/// The area of hexagons whose centres are at that distance.
inline double hexagon_area(double width) { return std::numbers::sqrt3 / 2 * width * width; }

} // namespace calotte::density_detail
