// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/triangle_quality.h"

#include "base/elementary.h"
#include "base/points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace calotte::io_detail {
namespace {

/// The sides of a triangle, shortest first.
struct SideLengths {
  double a, b, c;
};

SideLengths sorted(double x, double y, double z) {
  const double low = std::min(x, y), high = std::max(x, y);
  return {std::min(low, z), std::max(low, std::min(high, z)), std::max(high, z)};
}

SideLengths arcs(const Voronoi& voronoi, std::int64_t vertex) {
  const auto side = [&](int j) { return voronoi.dc[voronoi.edges_on_vertex(j, vertex)]; };
  return sorted(side(0), side(1), side(2));
}

/// The sides of the flat triangle.
SideLengths chords(const Voronoi& voronoi, std::int64_t vertex) {
  if (!voronoi.surface.is_sphere())
    return arcs(voronoi, vertex);
  const auto corner = [&](int j) {
    return column(voronoi.cells, voronoi.cells_on_vertex(j, vertex));
  };
  const Vec3 p = corner(0), q = corner(1), r = corner(2);
  return sorted(norm(q - p), norm(r - q), norm(p - r));
}

/// Half of an angle whose sine has this square.
CALOTTE_INLINE double half_angle(double square) {
  return arc_sine(std::sqrt(std::min(std::max(square, 0.0), 1.0)));
}

/// Smallest over largest angle of flat triangles with these sides, as MPAS's mesh converter has it:
/// 2 asin(sqrt((s - b)(s - c) / (b c))) is the angle between sides b and c, s half of the sum.
CALOTTE_VECTOR_WIDTHS
void angle_qualities(const double* a, const double* b, const double* c, std::int64_t count,
                     double* out) {
  for (std::int64_t i = 0; i < count; ++i) {
    const double to_a = 0.5 * ((c[i] - a[i]) + b[i]), to_b = 0.5 * ((c[i] - b[i]) + a[i]),
                 to_c = 0.5 * (a[i] - (c[i] - b[i]));
    out[i] = half_angle(to_b * to_c / (b[i] * c[i])) / half_angle(to_a * to_b / (a[i] * b[i]));
  }
}

} // namespace

bool has_triangle(const Voronoi& voronoi, std::int64_t vertex) {
  return voronoi.cells_on_vertex.col(vertex).minCoeff() >= 0 &&
         voronoi.edges_on_vertex.col(vertex).minCoeff() >= 0;
}

double side_quality(const Voronoi& voronoi, std::int64_t vertex) {
  if (!has_triangle(voronoi, vertex))
    return 0;
  const SideLengths sides = arcs(voronoi, vertex);
  return sides.a / sides.c;
}

bool is_obtuse(const Voronoi& voronoi, std::int64_t vertex) {
  if (!has_triangle(voronoi, vertex))
    return false;
  const auto [a, b, c] = chords(voronoi, vertex);
  return a * a + b * b - c * c < -2e-9 * a * b;
}

void fill_angle_qualities(const Voronoi& voronoi, std::int64_t begin, std::int64_t end,
                          double* out) {
  constexpr std::int64_t lanes = 64;
  std::array<std::array<double, lanes>, 3> sides;
  for (std::int64_t first = begin; first < end; first += lanes) {
    const std::int64_t count = std::min(lanes, end - first);
    for (std::int64_t i = 0; i < count; ++i) {
      const SideLengths of =
          has_triangle(voronoi, first + i) ? arcs(voronoi, first + i) : SideLengths{1, 1, 1};
      const auto lane = static_cast<std::size_t>(i);
      sides[0][lane] = of.a, sides[1][lane] = of.b, sides[2][lane] = of.c;
    }
    angle_qualities(sides[0].data(), sides[1].data(), sides[2].data(), count,
                    out + (first - begin));
    for (std::int64_t i = 0; i < count; ++i)
      if (!has_triangle(voronoi, first + i))
        out[first - begin + i] = 0;
  }
}

} // namespace calotte::io_detail
