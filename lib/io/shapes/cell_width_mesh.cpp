// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/cell_width_mesh.h"

#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/vec3.h"
#include "delaunay/delaunay.h"
#include "density/cell_width_field.h"
#include "exact/predicates.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace calotte::io_detail {
namespace {

Vec3 column(const Points3& points, Eigen::Index j) {
  return {points(0, j), points(1, j), points(2, j)};
}

/// The position of a direction relative to a triangle: its determinants with each edge, across from
/// vertices 0 to 2. All are positive inside.
std::array<double, 3> weights_in(const Mesh& mesh, std::int32_t triangle, const Vec3& p) {
  std::array<Vec3, 3> corners;
  for (int i = 0; i < 3; ++i)
    corners[static_cast<std::size_t>(i)] =
        normalised(column(mesh.points, mesh.triangles(i, triangle))) - p;
  // Computed from the corners relative to p, which avoids cancellation: det(p, b, c) = det(p, b -
  // p, c - p).
  return {dot(p, cross(corners[1], corners[2])), dot(p, cross(corners[2], corners[0])),
          dot(p, cross(corners[0], corners[1]))};
}

/// Walks from a triangle to one that contains p, across the edge that p is farthest beyond. The
/// walk ends among Delaunay triangles; the number of steps is limited because signs are rounded.
std::int32_t locate(const Mesh& mesh, std::int32_t triangle, const Vec3& p) {
  for (Eigen::Index step = 0; step < mesh.triangles.cols(); ++step) {
    const std::array<double, 3> weights = weights_in(mesh, triangle, p);
    const auto least = std::min_element(weights.begin(), weights.end());
    if (*least >= -1e-15)
      break;
    triangle = mesh.neighbours(least - weights.begin(), triangle);
  }
  return triangle;
}

double interpolate(const Mesh& mesh, const DoubleVector& widths, std::int32_t triangle,
                   const Vec3& p) {
  const std::array<double, 3> weights = weights_in(mesh, triangle, p);
  double sum = 0, total = 0;
  for (int i = 0; i < 3; ++i) {
    const double weight = std::max(0.0, weights[static_cast<std::size_t>(i)]);
    sum += weight * widths[mesh.triangles(i, triangle)];
    total += weight;
  }
  return sum / total;
}

/// Half of the spacing, in degrees, that a tenth of the edges are shorter than.
double step_for(const Mesh& mesh) {
  constexpr double finest = 0.05, coarsest = 1;
  std::vector<double> squares;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      const Vec3 edge = normalised(column(mesh.points, mesh.triangles(i, t))) -
                        normalised(column(mesh.points, mesh.triangles((i + 1) % 3, t)));
      squares.push_back(dot(edge, edge));
    }
  const auto tenth = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 10);
  std::nth_element(squares.begin(), tenth, squares.end());
  const double spacing = 2 * arc_sine(0.5 * std::sqrt(*tenth)) * 180 / std::numbers::pi;
  return std::clamp(0.5 * spacing, finest, coarsest);
}

} // namespace

CellWidth resampled(const Points3& points, const DoubleVector& widths) {
  const Mesh mesh = delaunay(points);
  if (!mesh.closed())
    throw Error(ErrorCode::invalid_argument,
                "the points lie within a hemisphere; give widths on the "
                "whole sphere");
  DoubleVector of_site(mesh.points.cols());
  for (Eigen::Index i = points.cols(); i-- > 0;) // the lowest duplicate is assigned last
    of_site[mesh.site_of_input[static_cast<std::size_t>(i)]] = widths[i];
  CellWidth grid = regular_grid(step_for(mesh));
  for_each_task(grid.latitudes.size(), [&](std::int64_t j) {
    std::int32_t triangle = 0;
    for (Eigen::Index i = 0; i < grid.longitudes.size(); ++i) {
      const Vec3 p = from_lonlat(grid.longitudes[i], grid.latitudes[j]);
      triangle = locate(mesh, triangle, p);
      grid.widths(i, j) = interpolate(mesh, of_site, triangle, p);
    }
  });
  return grid;
}

} // namespace calotte::io_detail
