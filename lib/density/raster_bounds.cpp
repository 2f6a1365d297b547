// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/raster_bounds.h"

#include "base/elementary.h"
#include "base/spherical_angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace calotte::density_detail {
namespace {

constexpr int finest_shift = 2;

struct Window {
  double west, east, south, north;
};

/// The window of longitudes and latitudes about a point of the sphere. \param reach less than a
/// half circle.
Window window_about(const Vec3& centre, double reach) {
  // The window is wider than sin(reach) requires; its operations have the same bits on every
  // machine.
  const double x = base_detail::longitude_of(centre.x, centre.y),
               y = base_detail::latitude_of(centre.x, centre.y, centre.z),
               ring = std::sqrt(centre.x * centre.x + centre.y * centre.y);
  const double across = reach < ring ? base_detail::arc_sine(reach / ring) : std::numbers::pi;
  return {x - across, x + across, y - reach, y + reach};
}

} // namespace

RasterBounds::RasterBounds(const RasterField& field)
    : RasterBounds(field, [&](std::int64_t i, std::int64_t j) { return field.value(i, j); }) {}

RasterBounds::RasterBounds(const RasterField& field,
                           const std::function<double(std::int64_t, std::int64_t)>& value)
    : field_(&field) {
  const std::int64_t columns = field.x().intervals() + 1, rows = field.y().intervals() + 1;
  Level finest{finest_shift, ((columns - 1) >> finest_shift) + 1, {}};
  finest.squares.resize(
      static_cast<std::size_t>(finest.columns * (((rows - 1) >> finest_shift) + 1)));
  for (std::int64_t j = 0; j < rows; ++j)
    for (std::int64_t i = 0; i < columns; ++i)
      finest
          .squares[static_cast<std::size_t>((j >> finest_shift) * finest.columns +
                                            (i >> finest_shift))]
          .add(value(i, j));
  levels_.push_back(std::move(finest));
  while (levels_.back().squares.size() > 1) {
    const Level& fine = levels_.back();
    const std::int64_t fine_rows = std::ssize(fine.squares) / fine.columns;
    Level coarse{fine.shift + 1, (fine.columns + 1) / 2, {}};
    coarse.squares.resize(static_cast<std::size_t>(coarse.columns * ((fine_rows + 1) / 2)));
    for (std::int64_t j = 0; j < fine_rows; ++j)
      for (std::int64_t i = 0; i < fine.columns; ++i)
        coarse.squares[static_cast<std::size_t>(j / 2 * coarse.columns + i / 2)].add(
            fine.squares[static_cast<std::size_t>(j * fine.columns + i)]);
    levels_.push_back(std::move(coarse));
  }
}

/// The bounds of all nodes in some columns and rows, both ends included.
Bounds RasterBounds::of_nodes(std::int64_t west, std::int64_t east, std::int64_t south,
                              std::int64_t north) const {
  constexpr std::int64_t most = 3; // squares in a row
  std::size_t k = 0;
  while (k + 1 < levels_.size() && std::max(east - west, north - south) >> levels_[k].shift >= most)
    ++k;
  const Level& level = levels_[k];
  Bounds bounds;
  for (std::int64_t j = south >> level.shift; j <= north >> level.shift; ++j)
    for (std::int64_t i = west >> level.shift; i <= east >> level.shift; ++i)
      bounds.add(level.squares[static_cast<std::size_t>(j * level.columns + i)]);
  return bounds;
}

Bounds RasterBounds::within(const Vec3& centre, double reach) const {
  const Axis &x = field_->x(), &y = field_->y();
  const auto bounds = [&](double west, double east, double south, double north) {
    return of_nodes(x.interval(west), x.interval(east) + 1, y.interval(south),
                    y.interval(north) + 1);
  };
  if (field_->of_plane())
    return bounds(centre.x - reach, centre.x + reach, centre.y - reach, centre.y + reach);
  if (!(reach < std::numbers::pi / 2))
    return levels_.back().squares.front();
  constexpr double slack = 1e-9, turn = 2 * std::numbers::pi;
  const Window window = window_about(centre, reach + slack);
  // The west end lies on the raster, the east end on it or on its next turn.
  const double west = window.west - turn * std::floor((window.west - x[0]) / turn),
               east = west + (window.east - window.west);
  Bounds all = bounds(west, east, window.south, window.north);
  if (east > x[x.intervals()])
    all.add(bounds(x[0], east - turn, window.south, window.north));
  return all;
}

} // namespace calotte::density_detail
