// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/generators.h>

#include "base/circle.h"
#include "base/points.h"
#include "base/require.h"
#include "base/split_mix.h"
#include "base/vec3.h"
#include "density/sampling.h"
#include "domain/surface.h"
#include "exact/space.h"
#include "generators/room.h"
#include "mesh/edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

// The code uses only + - * / and sqrt, each rounded once, so that every machine gives the same
// bits; sin and cos differ between builds of a C library.

namespace calotte {
namespace {

using base_detail::cos_sin_of_octant;
using base_detail::CosSin;
using base_detail::require;
using base_detail::require_count;
using base_detail::SplitMix;
using base_detail::Vec3;
using generators_detail::most_points;

void put(Points3& points, std::int64_t column, const Vec3& p) {
  points.col(column) << p.x, p.y, p.z;
}

Vec3 get(const Points3& points, std::int64_t column) {
  return {points(0, column), points(1, column), points(2, column)};
}

// ---- Angles

/// Cosine and sine of k/n turns, 0 <= k < n <= 2^58.
CosSin cos_sin(std::int64_t k, std::int64_t n) {
  const int octant = static_cast<int>(8 * k / n);
  const std::int64_t rest = 8 * k % n;
  const std::int64_t part = octant % 2 == 0 ? rest : n - rest;
  return cos_sin_of_octant(octant, static_cast<double>(part) / static_cast<double>(n));
}

/// Cosine and sine of an angle in units of 2^-64 turns: additions of such angles wrap around
/// without error.
CosSin cos_sin(std::uint64_t turns) {
  constexpr std::uint64_t eighth = std::uint64_t{1} << 61;
  const int octant = static_cast<int>(turns / eighth);
  const std::uint64_t rest = turns % eighth;
  const std::uint64_t part = octant % 2 == 0 ? rest : eighth - rest;
  return cos_sin_of_octant(octant, static_cast<double>(part) * 0x1p-61);
}

// ---- Hexagons

using Triple = std::array<std::int32_t, 3>;

/// A triangle's vertices, starting with the lowest, and the triangles across from them.
struct LinkedTriangle {
  Triple vertices, neighbours;
};

LinkedTriangle from_lowest(const Triple& v, const Triple& across) {
  const auto first = static_cast<std::size_t>(std::min_element(v.begin(), v.end()) - v.begin());
  const std::size_t second = (first + 1) % 3, third = (first + 2) % 3;
  return {{v[first], v[second], v[third]}, {across[first], across[second], across[third]}};
}

/// The triangles of a hexagonal lattice, two for each site i: 2i contains the next site in the row,
/// 2i + 1 has its tip at site i.
std::vector<LinkedTriangle> hexagons_triangles(std::int64_t columns, std::int64_t rows) {
  std::vector<LinkedTriangle> out;
  out.reserve(static_cast<std::size_t>(2 * columns * rows));
  const auto site = [&](std::int64_t row, std::int64_t column) {
    return static_cast<std::int32_t>((row + rows) % rows * columns + (column + columns) % columns);
  };
  for (std::int64_t r = 0; r < rows; ++r)
    for (std::int64_t c = 0; c < columns; ++c) {
      const std::int64_t odd = r % 2;
      const std::int32_t i = site(r, c), left = site(r, c - 1), right = site(r, c + 1),
                         above_left = site(r + 1, c + odd - 1), above = site(r + 1, c + odd),
                         below = site(r - 1, c + odd);
      out.push_back(from_lowest({i, right, above}, {2 * right + 1, 2 * i + 1, 2 * below + 1}));
      out.push_back(from_lowest({i, above, above_left}, {2 * above_left, 2 * left, 2 * i}));
    }
  return out;
}

/// Sets the triangles of a hexagonal lattice, sorted by their vertices.
void set_hexagons_triangles(std::int64_t columns, std::int64_t rows, Mesh& mesh) {
  const std::vector<LinkedTriangle> triangles = hexagons_triangles(columns, rows);
  std::vector<std::int32_t> order(triangles.size()), index(triangles.size());
  std::iota(order.begin(), order.end(), 0);
  const auto triangle = [&](std::int32_t t) { return triangles[static_cast<std::size_t>(t)]; };
  std::sort(order.begin(), order.end(), [&](std::int32_t s, std::int32_t t) {
    return triangle(s).vertices < triangle(t).vertices;
  });
  for (std::size_t t = 0; t < order.size(); ++t)
    index[static_cast<std::size_t>(order[t])] = static_cast<std::int32_t>(t);
  mesh.triangles.resize(3, std::ssize(triangles));
  mesh.neighbours.resize(3, std::ssize(triangles));
  for (std::size_t t = 0; t < order.size(); ++t) {
    const LinkedTriangle from = triangle(order[t]);
    for (std::size_t v = 0; v < 3; ++v) {
      const auto row = static_cast<Eigen::Index>(v), column = static_cast<Eigen::Index>(t);
      mesh.triangles(row, column) = from.vertices[v];
      mesh.neighbours(row, column) = index[static_cast<std::size_t>(from.neighbours[v])];
    }
  }
}

/// Removes the points from index `first` on that lie outside.
Points3 inside_after(std::int64_t first, Points3&& points, const Surface& surface) {
  std::int64_t next = first;
  for (std::int64_t i = first; i < points.cols(); ++i)
    if (surface.contains(points.col(i)))
      points.col(next++) = points.col(i);
  points.conservativeResize(Eigen::NoChange, next);
  return std::move(points);
}

} // namespace

Points3 random_points(std::int64_t n, const Surface& surface, const Density& density,
                      std::uint64_t seed) {
  require_count(n, 1, "the number of points");
  if (surface.is_whole_sphere())
    return random_sphere(n, density, seed);
  return density_detail::draw(n, density, surface, seed);
}

Points3 random_sphere(std::int64_t n, std::uint64_t seed) {
  require_count(n, 1, "the number of points");
  Points3 points;
  points.resize(3, n);
  SplitMix random(seed);
  for (std::int64_t i = 0; i < n; ++i) {
    double u, v, s;
    do {
      u = random.signed_unit();
      v = random.signed_unit();
      s = u * u + v * v;
    } while (s >= 1);
    const double scale = 2 * std::sqrt(1 - s);
    put(points, i, {scale * u, scale * v, 1 - 2 * s});
  }
  return points;
}

Points3 random_sphere(std::int64_t n, const Density& density, std::uint64_t seed) {
  require_count(n, 1, "the number of points");
  return density.uniform() ? random_sphere(n, seed)
                           : density_detail::draw(n, density, Surface::sphere(), seed);
}

Points3 fibonacci_sphere(std::int64_t n) {
  require_count(n, 1, "the number of points");
  // (3 - sqrt 5)/2 turns, to 128 bits.
  constexpr std::uint64_t golden_high = 0x61c8864680b583ea, golden_next = 0x0c633f9fa31237cb;
  Points3 points(3, n);
  for (std::int64_t i = 0; i < n; ++i) {
    // The lower half contributes i * golden_next / 2^64 < 2^30 units: its top 32 bits suffice.
    const auto count = static_cast<std::uint64_t>(i);
    const CosSin longitude = cos_sin(count * golden_high + ((count * (golden_next >> 32)) >> 32));
    const double z = static_cast<double>(n - (2 * i + 1)) / static_cast<double>(n);
    const double across = static_cast<double>((2 * i + 1) * (2 * n - (2 * i + 1)));
    const double radius = std::sqrt(across) / static_cast<double>(n);
    put(points, i, {radius * longitude.cos, radius * longitude.sin, z});
  }
  return points;
}

Points3 spiral_sphere(std::int64_t n) {
  require_count(n, 2, "the number of points");
  constexpr double step = 0x1.255ab960267a9p-1; // 3.6 / (2 pi)
  const double last = static_cast<double>(n - 1), root = std::sqrt(static_cast<double>(n));
  Points3 points(3, n);
  put(points, 0, {0, 0, -1});
  put(points, n - 1, {0, 0, 1});
  std::uint64_t turns = 0;
  for (std::int64_t i = 1; i < n - 1; ++i) {
    const double z = static_cast<double>(2 * i - (n - 1)) / last;
    const double radius = 2 * std::sqrt(static_cast<double>(i * (n - 1 - i))) / last;
    turns += static_cast<std::uint64_t>(step / (root * radius) * 0x1p64);
    const CosSin longitude = cos_sin(turns);
    put(points, i, {radius * longitude.cos, radius * longitude.sin, z});
  }
  return points;
}

Points3 lat_lon_sphere(std::int64_t latitudes, std::int64_t longitudes, bool poles) {
  require_count(latitudes, 1, "the number of latitudes");
  require_count(longitudes, 3, "the number of longitudes");
  require(latitudes <= most_points / longitudes,
          "the grid has more than {} points; give fewer rows", most_points);
  const std::int64_t n = latitudes * longitudes;
  Points3 points(3, n + (poles ? 2 : 0));
  for (std::int64_t j = 0; j < latitudes; ++j) {
    const std::int64_t north = 2 * j + 1 - latitudes; // of 4 * latitudes in a turn
    const CosSin latitude = cos_sin(std::abs(north), 4 * latitudes);
    const double z = north < 0 ? -latitude.sin : latitude.sin;
    for (std::int64_t i = 0; i < longitudes; ++i) {
      const CosSin longitude = cos_sin(i, longitudes);
      put(points, j * longitudes + i,
          {latitude.cos * longitude.cos, latitude.cos * longitude.sin, z});
    }
  }
  if (poles) {
    put(points, n, {0, 0, -1});
    put(points, n + 1, {0, 0, 1});
  }
  return points;
}

Points3 cubed_sphere(std::int64_t m) {
  require_count(m, 1, "the number of cells along an edge");
  require(m <= 13377, "the grid has more than {} points; give at most 13377 cells along an edge",
          most_points);
  std::vector<double> tangents(m);
  for (std::int64_t i = 0; i < m; ++i) {
    const std::int64_t right = 2 * i + 1 - m; // of 8 m in a turn
    const CosSin angle = cos_sin(std::abs(right), 8 * m);
    tangents[i] = (right < 0 ? -angle.sin : angle.sin) / angle.cos;
  }
  Points3 points(3, 6 * m * m);
  for (std::int64_t j = 0; j < m; ++j) {
    for (std::int64_t i = 0; i < m; ++i) {
      const double u = tangents[i], v = tangents[j];
      const double length = std::sqrt(1 + (u * u + v * v));
      const double a = 1 / length, b = u / length, c = v / length;
      const std::array<Vec3, 6> faces{Vec3{a, b, c}, {-b, a, c}, {-a, -b, c},
                                      {b, -a, c},    {-c, b, a}, {c, b, -a}};
      for (std::int64_t face = 0; face < 6; ++face)
        put(points, (face * m + j) * m + i, faces[face]);
    }
  }
  return points;
}

Points3 bisect(const Mesh& mesh) {
  const std::int64_t n = mesh.points.cols();
  const mesh_detail::EdgeCount edges = mesh_detail::count_edges(mesh);
  Points3 points(3, n + edges.all);
  points.leftCols(n) = mesh.points;
  exact_detail::in_space_of(mesh.surface, [&](const exact_detail::Space auto& space) {
    mesh_detail::for_each_edge(mesh, edges, [&](std::int64_t e, std::int32_t a, std::int32_t b) {
      put(points, n + e, space.midpoint(get(points, a), get(points, b)));
    });
  });
  return mesh.surface.is_bounded() ? inside_after(n, std::move(points), mesh.surface) : points;
}

Mesh hexagonal_box(std::int64_t columns, std::int64_t rows, double spacing) {
  require_count(columns, 3, "the number of columns");
  require_count(rows, 4, "the number of rows");
  require(rows % 2 == 0,
          "the number of rows is {}; give an even one, as every second row is shifted", rows);
  require(rows <= most_points / columns, "the plane has more than {} cells; give fewer rows",
          most_points);
  const double rise = spacing * (std::numbers::sqrt3 / 2);
  const Eigen::Vector2d period(static_cast<double>(columns) * spacing,
                               static_cast<double>(rows) * rise);
  require(rise > 0 && period.allFinite(), "the spacing is {}; give a positive number", spacing);
  Mesh mesh;
  mesh.surface = Surface::periodic(period);
  mesh.points.resize(3, columns * rows);
  for (std::int64_t r = 0; r < rows; ++r)
    for (std::int64_t c = 0; c < columns; ++c)
      mesh.points.col(r * columns + c)
          << (static_cast<double>(c) + (r % 2 == 0 ? 0 : 0.5)) * spacing,
          static_cast<double>(r) * rise, 0;
  set_hexagons_triangles(columns, rows, mesh);
  mesh.site_of_input = base_detail::themselves(mesh.points.cols());
  return mesh;
}

} // namespace calotte
