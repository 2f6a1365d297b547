// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "curve/box_tree.h"
#include "density/room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// The least of many functions at points, each of an item of a tree: the distance from the nearest
/// line, the least width that discs allow. One search of the tree finds the few items that can be
/// the least anywhere in a ball around some hundred points.
namespace calotte::density_detail {

/// A number for each of some points, for vector code.
constexpr std::size_t row_size = 16;
using RowValues = std::array<double, row_size>;

/// Points as rows of their coordinates. A short row repeats its last point.
struct PointRow {
  RowValues x, y, z;

  explicit PointRow(std::span<const Vec3> points) {
    for (std::size_t k = 0; k < row_size; ++k) {
      const Vec3& p = points[std::min(k, points.size() - 1)];
      x[k] = p.x, y[k] = p.y, z[k] = p.z;
    }
  }
};

/// A ball that contains some points.
struct Ball {
  Vec3 middle;
  double reach; ///< straight
};

inline Ball ball_around(std::span<const Vec3> points) {
  curve_detail::Box3 box;
  for (const Vec3& p : points)
    box = joined(box, {p, p});
  Ball ball{0.5 * (box.low + box.high), 0};
  for (const Vec3& p : points)
    ball.reach = std::max(ball.reach, norm(p - ball.middle));
  constexpr double rounding = 1e-14; // on the unit sphere; in a plane bounds have margins
  ball.reach += rounding;
  return ball;
}

/// The items of a tree that can be the least at a point of a ball: a bound of their function is
/// less than what one item, which comes first, gives all over the ball.
/// \param limit what counts is less than this.
/// \param most the search ends after one more item.
template <class Functions>
std::vector<std::int32_t> near_items(const Functions& functions, const Ball& ball, double limit,
                                     std::size_t most) {
  const PointRow middle({&ball.middle, 1});
  RowValues reach, least, greatest;
  reach.fill(ball.reach);
  std::vector<std::int32_t> near;
  functions.tree().visit_nearest(
      [&](const auto& bounds) {
        return functions.least(bounds, {ball.middle, -ball.reach}, limit);
      },
      limit,
      [&](std::int32_t k) {
        functions.set_bounds(functions.item(k), middle, reach, least, greatest);
        if (greatest[0] < limit) {
          limit = greatest[0];
          near = {k};
        }
      });
  functions.tree().visit(
      [&](const auto& bounds) {
        return near.size() <= most && functions.least(bounds, ball, limit) < limit;
      },
      [&](std::int32_t k) {
        if (near.empty() || k != near.front())
          near.push_back(k);
      });
  return near;
}

/// The points and values of a row.
template <class T> std::span<T> row_of(std::span<T> all, std::size_t row) {
  return all.subspan(row * row_size, std::min(row_size, all.size() - row * row_size));
}

template <class Functions> double limit_of(const Functions& functions, std::span<double> values) {
  return functions.bound(*std::max_element(values.begin(), values.end()));
}

/// Lowers values to the functions of some items, at up to row_size rows of points. Each row leaves
/// out the items that are not the least in a ball around it.
template <class Functions>
void lower_rows(const Functions& functions, const std::vector<std::int32_t>& near,
                std::span<const Vec3> points, std::span<double> values) {
  const std::size_t rows = (points.size() + row_size - 1) / row_size;
  std::vector<Vec3> middles;
  RowValues reaches{}, limits;
  for (std::size_t row = 0; row < rows; ++row) {
    const Ball ball = ball_around(row_of(points, row));
    middles.push_back(ball.middle);
    reaches[row] = ball.reach;
    limits[row] = limit_of(functions, row_of(values, row));
  }
  const PointRow middle_row(middles);
  std::vector<typename Functions::Item> items;
  std::vector<RowValues> leasts;
  items.reserve(near.size());
  leasts.reserve(near.size());
  std::array<std::size_t, row_size> best{}; // an item that gives the limit
  RowValues greatest;
  for (const std::int32_t k : near) {
    items.push_back(functions.item(k));
    leasts.emplace_back();
    functions.set_bounds(items.back(), middle_row, reaches, leasts.back(), greatest);
    for (std::size_t row = 0; row < rows; ++row)
      if (greatest[row] < limits[row]) {
        limits[row] = greatest[row];
        best[row] = items.size() - 1;
      }
  }
  for (std::size_t row = 0; row < rows; ++row) {
    const PointRow at(row_of(points, row));
    const std::span<double> own = row_of(values, row);
    RowValues lowered{};
    std::copy(own.begin(), own.end(), lowered.begin());
    for (std::size_t k = 0; k < items.size(); ++k)
      if (k == best[row] || leasts[k][row] < limits[row])
        functions.lower(items[k], at, lowered);
    std::copy_n(lowered.begin(), own.size(), own.begin());
  }
}

/// Lowers values at points to the least function of an item. Fast if consecutive points are near
/// each other. The bits of a value depend on its point alone: an item is left out only where
/// another one is less, or equal to the last bit.
/// \tparam Functions of the items of a tree. Their values may be other numbers than their bounds,
/// in the same order, such as squares. It has
///   tree()                                a BoundsTree
///   least(bounds, ball, limit)            a bound of the functions of some items in a ball; any
///                                         number from the limit on if it is not less than that
///   Item, item(k)                         the function of item k
///   set_bounds(item, middles, reaches, least, greatest)  in the balls of a row
///   lower(item, points, values)           lowers the values of a row to the function's
///   bound(value)                          from which on a bound cannot lower a value
template <class Functions>
void lower_to_least(const Functions& functions, std::span<const Vec3> points,
                    std::span<double> values) {
  constexpr std::size_t most_points = row_size * row_size, many = 256;
  const std::size_t count = points.size(),
                    most_items = count > 1 ? many : std::numeric_limits<std::size_t>::max();
  if (count == 0)
    return;
  if (count <= most_points) {
    const std::vector<std::int32_t> near =
        near_items(functions, ball_around(points), limit_of(functions, values), most_items);
    if (near.size() <= most_items)
      return lower_rows(functions, near, points, values);
  }
  lower_to_least(functions, points.first(count / 2), values.first(count / 2));
  lower_to_least(functions, points.subspan(count / 2), values.subspan(count / 2));
}

} // namespace calotte::density_detail
