// SPDX-License-Identifier: GPL-3.0-or-later
#include "oceans/shore_points.h"

#include "base/lonlat.h"
#include "curve/hilbert.h"
#include "density/width_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace calotte::oceans_detail {
namespace {

/// The square [u, u + size] x [v, v + size] of a face of the cube [-1,1]^3.
struct Square {
  int face;
  double u, v, size;

  /// The square of the distance of its centre from the middle of the cube.
  double square_away() const {
    const double x = u + 0.5 * size, y = v + 0.5 * size;
    return 1 + x * x + y * y;
  }
  Vec3 centre() const {
    return normalised(curve_detail::from_cube({face, u + 0.5 * size, v + 0.5 * size}));
  }
  /// The longest side on the sphere, radians; less than that where the square is large.
  double side() const { return size / std::sqrt(square_away()); }
  double area() const { return size * size / (square_away() * std::sqrt(square_away())); }
};

std::vector<Square> first_squares() {
  constexpr int on_side = 16;
  constexpr double size = 2.0 / on_side;
  std::vector<Square> squares;
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < on_side; ++i)
      for (int j = 0; j < on_side; ++j)
        squares.push_back({face, -1 + size * i, -1 + size * j, size});
  return squares;
}

void add_quarters(const Square& square, std::vector<Square>& to) {
  const double half = 0.5 * square.size;
  for (const double u : {square.u, square.u + half})
    for (const double v : {square.v, square.v + half})
      to.push_back({square.face, u, v, half});
}

/// The longest side that a square may have. Passages are half a width wide on both sides.
double longest_side(double from_coast, double from_passage, double width, double side) {
  constexpr double half_diagonal = 0.75, growth = 0.5;
  const double away = std::min(std::abs(from_coast), from_passage - 0.5 * width) -
                      half_diagonal * side - shore::band * width;
  return shore::step * width + growth * std::max(0.0, away);
}

/// Squares of one level, and what is known of their centres.
struct Level {
  std::vector<Square> squares;
  ShorePoints at;
};

/// The distances that count: beyond the border those from the border alone, so that no points
/// resolve the coast there.
void take_border(const Seas& seas, ShorePoints& at) {
  if (!seas.border)
    return;
  const std::vector<double> from_border = distances_at(*seas.border, at.points);
  for (Eigen::Index k = 0; k < at.points.cols(); ++k)
    if (!seas.within.contains(at.points.col(k)))
      at.from_coast[static_cast<std::size_t>(k)] = from_border[static_cast<std::size_t>(k)];
}

Level make_level(std::vector<Square> squares, const LineDistance& coast, const Seas& seas,
                 const std::optional<LineDistance>& passages, const Widths& widths) {
  const auto count = std::ssize(squares);
  Level level{std::move(squares), {}};
  ShorePoints& at = level.at;
  at.points.resize(3, count);
  at.areas.resize(level.squares.size());
  for (std::int64_t k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    set_column(at.points, k, level.squares[i].centre());
    at.areas[i] = level.squares[i].area();
  }
  at.widths = demanded_at(widths, at.points);
  at.from_coast = distances_at(coast, at.points);
  take_border(seas, at);
  at.from_passage =
      passages ? distances_at(*passages, at.points)
               : std::vector<double>(level.squares.size(), std::numeric_limits<double>::infinity());
  for_each_block(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k != end; ++k)
      if (!seas.has(column(at.points, k)))
        at.from_coast[static_cast<std::size_t>(k)] *= -1;
  });
  return level;
}

} // namespace

std::vector<double> demanded_at(const Widths& widths, const Points3& points) {
  const DoubleVector km = evaluate(widths, points);
  std::vector<double> radians(static_cast<std::size_t>(km.size()));
  for (Eigen::Index k = 0; k < km.size(); ++k) {
    if (!Widths::is_demand(km[k])) {
      const base_detail::LonLat at = base_detail::lonlat_of(column(points, k));
      density_detail::refuse_point(at.longitude, at.latitude, false);
    }
    radians[static_cast<std::size_t>(k)] = km[k] / widths.radius_km();
  }
  return radians;
}

namespace {

/// \param farthest(begin, end) of the points of a block.
template <class Farthest>
std::vector<double> distances_within(const LineDistance& lines, const Points3& points,
                                     const Farthest& farthest) {
  std::vector<double> distances(static_cast<std::size_t>(points.cols()));
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    const auto count = static_cast<std::size_t>(end - begin);
    lines({&column(points, begin), count},
          std::span(distances).subspan(static_cast<std::size_t>(begin), count),
          farthest(begin, end));
  });
  return distances;
}

} // namespace

std::vector<double> distances_at(const LineDistance& lines, const Points3& points) {
  return distances_within(lines, points, [](std::int64_t, std::int64_t) {
    return std::numeric_limits<double>::infinity();
  });
}

std::vector<double> near_distances_at(const LineDistance& lines, const ShorePoints& at) {
  return distances_within(lines, at.points, [&](std::int64_t begin, std::int64_t end) {
    return 1.5 * *std::max_element(at.widths.begin() + begin, at.widths.begin() + end);
  });
}

ShorePoints shore_points(const LineDistance& coast, const Seas& seas,
                         const std::optional<LineDistance>& passages, const Widths& widths) {
  constexpr std::size_t most = 20'000'000;
  ShorePoints all;
  std::vector<Vec3> points;
  for (std::vector<Square> squares = first_squares(); !squares.empty();) {
    require(points.size() + squares.size() <= most,
            "the widths require more than 20 million points along the coast; give larger ones");
    const Level level = make_level(std::move(squares), coast, seas, passages, widths);
    squares.clear();
    for (std::size_t i = 0; i < level.squares.size(); ++i) {
      const ShorePoints& at = level.at;
      const double side = level.squares[i].side();
      if (side > longest_side(at.from_coast[i], at.from_passage[i], at.widths[i], side)) {
        add_quarters(level.squares[i], squares);
        continue;
      }
      points.push_back(column(at.points, static_cast<std::int64_t>(i)));
      all.areas.push_back(at.areas[i]);
      all.widths.push_back(at.widths[i]);
      all.from_coast.push_back(at.from_coast[i]);
      all.from_passage.push_back(at.from_passage[i]);
    }
  }
  all.points.resize(3, std::ssize(points));
  for (std::size_t i = 0; i < points.size(); ++i)
    set_column(all.points, static_cast<std::int64_t>(i), points[i]);
  return all;
}

} // namespace calotte::oceans_detail
