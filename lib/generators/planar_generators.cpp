// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/generators.h>

#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "domain/outline.h"
#include "domain/surface.h"
#include "generators/room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace calotte {
namespace {

using base_detail::require;
using base_detail::require_count;
using domain_detail::Outline;
using domain_detail::Side;
using exact_detail::Vec2;
using generators_detail::most_points;

constexpr double rise = std::numbers::sqrt3 / 2; ///< of rows, over the spacing

// ---- The lattice of a polygon

struct Lattice {
  Vec2 corner; ///< x_0, y_0
  double spacing;
  std::int64_t rows, columns; ///< that reach beyond the box

  Lattice(const Outline& outline, double of_spacing)
      : corner(outline.box().low), spacing(of_spacing),
        rows(count(outline.box().high.y - corner.y, rise * spacing)),
        columns(count(outline.box().high.x - corner.x, spacing)) {}

  Vec2 point(std::int64_t row, std::int64_t column) const {
    const double shift = row % 2 == 0 ? 0.25 : 0.75;
    return {corner.x + (static_cast<double>(column) + shift) * spacing,
            corner.y + (static_cast<double>(row) + 0.5) * (rise * spacing)};
  }

private:
  /// The number of rows or columns, at most that of a box with most_points points that is as narrow
  /// as the spacing.
  static std::int64_t count(double extent, double step) {
    return static_cast<std::int64_t>(std::min(extent / step + 1, double(8 * most_points)));
  }
};

/// Calls body(point) for the points of some rows that are inside.
template <class Body>
void for_each_inside(const Outline& outline, const Lattice& lattice, std::int64_t row,
                     const Body& body) {
  for (std::int64_t column = 0; column < lattice.columns; ++column)
    if (const Vec2 point = lattice.point(row, column); outline.side(point) == Side::inside)
      body(point);
}

/// The number of points inside, for each row.
std::vector<std::int64_t> count_rows(const Outline& outline, const Lattice& lattice) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(lattice.rows));
  base_detail::for_each_task(lattice.rows, [&](std::int64_t row) {
    for_each_inside(outline, lattice, row,
                    [&](const Vec2&) { ++counts[static_cast<std::size_t>(row)]; });
  });
  return counts;
}

std::int64_t count_inside(const Outline& outline, double spacing) {
  const std::vector<std::int64_t> counts = count_rows(outline, Lattice(outline, spacing));
  std::int64_t sum = 0;
  for (const std::int64_t count : counts)
    sum += count;
  return sum;
}

/// Finds, among the spacings that a bisection tries, the one whose number of points is nearest to
/// n. A wider spacing gives fewer points in general, but not monotonically.
double spacing_for(std::int64_t n, const Outline& outline) {
  const double first = std::sqrt(outline.area() / (rise * static_cast<double>(n)));
  std::int64_t best_miss = std::numeric_limits<std::int64_t>::max();
  double best = first;
  const auto misses = [&](double spacing) {
    const std::int64_t miss = count_inside(outline, spacing) - n;
    if (std::abs(miss) < best_miss) {
      best_miss = std::abs(miss);
      best = spacing;
    }
    return miss;
  };
  // Brackets the spacing: a boundary may have any length, and halving the spacing gives 4 times as
  // many points.
  double low = first, high = first;
  constexpr int most_steps = 24;
  const std::int64_t miss = misses(first);
  for (int step = 0; step < 6 && miss < 0 && misses(low /= 1 + std::ldexp(1, step - 6)) < 0; ++step)
    high = low;
  for (int step = 0; step < 6 && miss > 0 && misses(high *= 1 + std::ldexp(1, step - 6)) > 0;
       ++step)
    low = high;
  for (int step = 0; step < most_steps && best_miss > 0; ++step) {
    const double middle = low + (high - low) / 2;
    (misses(middle) > 0 ? low : high) = middle;
  }
  return best;
}

Points3 lattice_inside(std::int64_t n, const Outline& outline) {
  const Lattice lattice(outline, spacing_for(n, outline));
  std::vector<std::int64_t> begin = count_rows(outline, lattice);
  const std::int64_t total = base_detail::exclusive_scan(std::span(begin));
  require(total > 0, "no place of a lattice of {} places is inside the domain; increase the number",
          n);
  Points3 points(3, total);
  base_detail::for_each_task(lattice.rows, [&](std::int64_t row) {
    std::int64_t next = begin[static_cast<std::size_t>(row)];
    for_each_inside(outline, lattice, row,
                    [&](const Vec2& p) { points.col(next++) << p.x, p.y, 0; });
  });
  return points;
}

// ---- The lattice of a periodic box

struct Grid {
  std::int64_t columns = 0, rows = 0;
};

/// The sum of the relative errors of shape and number, see the header.
double relative_error(const Grid& grid, std::int64_t n, const Eigen::Vector2d& period) {
  const auto columns = static_cast<double>(grid.columns), rows = static_cast<double>(grid.rows);
  const double shape = (period.y() / rows) / (period.x() / columns) / rise;
  const double number = columns * rows / static_cast<double>(n);
  return std::max(shape, 1 / shape) + std::max(number, 1 / number) - 2;
}

Grid grid_for(std::int64_t n, const Eigen::Vector2d& period) {
  const double ideal = std::sqrt(static_cast<double>(n) * (period.y() / period.x()) / rise);
  constexpr std::int64_t least_columns = 3, least_rows = 4, around = 8;
  const std::int64_t most_rows = n / least_columns / 2 * 2;
  const std::int64_t middle =
      std::clamp(2 * static_cast<std::int64_t>(std::min(ideal / 2, double(most_points))),
                 least_rows, std::max(most_rows, least_rows));
  Grid best;
  double least = std::numeric_limits<double>::infinity();
  for (std::int64_t rows = std::max(least_rows, middle - around); rows <= middle + around;
       rows += 2) {
    const double by_number = static_cast<double>(n) / static_cast<double>(rows),
                 by_shape = period.x() / period.y() * static_cast<double>(rows) * rise;
    for (const double columns : {by_number, by_number + 1, by_shape, by_shape + 1}) {
      const Grid grid{std::clamp(static_cast<std::int64_t>(std::min(columns, double(most_points))),
                                 least_columns, most_points / rows),
                      rows};
      if (const double miss = relative_error(grid, n, period); miss < least) {
        least = miss;
        best = grid;
      }
    }
  }
  return best;
}

/// The spacing of hexagonal_box() that gives this box exactly, if there is one.
std::optional<double> regular_spacing(const Grid& grid, const Eigen::Vector2d& period) {
  const double near = period.x() / static_cast<double>(grid.columns);
  for (const double spacing : {near, std::nextafter(near, 0.0), std::nextafter(near, 2 * near)})
    if (static_cast<double>(grid.columns) * spacing == period.x() &&
        static_cast<double>(grid.rows) * (spacing * rise) == period.y())
      return spacing;
  return std::nullopt;
}

Points3 lattice_of_box(std::int64_t n, const Eigen::Vector2d& period) {
  const Grid grid = grid_for(n, period);
  if (const std::optional<double> spacing = regular_spacing(grid, period))
    return hexagonal_box(grid.columns, grid.rows, *spacing).points;
  const double across = period.x() / static_cast<double>(grid.columns),
               up = period.y() / static_cast<double>(grid.rows);
  Points3 points(3, grid.columns * grid.rows);
  for (std::int64_t row = 0; row < grid.rows; ++row)
    for (std::int64_t column = 0; column < grid.columns; ++column)
      points.col(row * grid.columns + column)
          << (static_cast<double>(column) + (row % 2 == 0 ? 0 : 0.5)) * across,
          static_cast<double>(row) * up, 0;
  return points;
}

} // namespace

Points3 hexagonal_lattice(std::int64_t n, const Surface& surface) {
  domain_detail::require_plane(surface, "a hexagonal lattice is");
  require_count(n, surface.is_bounded() ? 1 : 12, "the number of points");
  if (surface.is_bounded())
    return lattice_inside(n, *domain_detail::outline_of<exact_detail::Plane>(surface));
  domain_detail::require_finite_plane(surface);
  return lattice_of_box(n, surface.period());
}

} // namespace calotte
