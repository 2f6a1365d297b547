// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/cell_width_mesh.h"

#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/points.h"
#include "base/require.h"
#include "density/raster_field.h"

#include <calotte/delaunay.h>
#include <calotte/locate.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace calotte::io_detail {
namespace {

/// The width of each site: that of its first input point.
DoubleVector site_widths(const Mesh& mesh, const DoubleVector& widths) {
  DoubleVector of_site(mesh.points.cols());
  for (Eigen::Index i = widths.size(); i-- > 0;)
    of_site[mesh.site_of_input[static_cast<std::size_t>(i)]] = widths[i];
  return of_site;
}

/// Fills the values of a grid, first x second, by interpolation on the mesh.
/// \param position(i, j) of a node.
template <class Position>
void fill(const Mesh& mesh, const DoubleVector& of_site, const Position& position,
          DoubleMatrix& values) {
  constexpr Eigen::Index at_once = 1 << 20; // positions
  const Locator locator(mesh);
  const Eigen::Index nx = values.rows(), rows = std::max<Eigen::Index>(1, at_once / nx);
  for (Eigen::Index begin = 0; begin < values.cols(); begin += rows) {
    const Eigen::Index end = std::min(begin + rows, values.cols());
    Points3 positions(3, nx * (end - begin));
    for (Eigen::Index j = begin; j < end; ++j)
      for (Eigen::Index i = 0; i < nx; ++i)
        base_detail::set_column(positions, (j - begin) * nx + i, position(i, j));
    const Locations found = locator.find(positions);
    for (Eigen::Index k = 0; k < positions.cols(); ++k) {
      double width = of_site[found.nearest[k]];
      if (const std::int32_t t = found.triangle[k]; t >= 0) {
        width = 0;
        for (int v = 0; v < 3; ++v)
          width += found.weights(v, k) * of_site[mesh.triangles(v, t)];
      }
      values(k % nx, begin + k / nx) = width;
    }
  }
}

/// The first decile of the lengths of the edges.
double short_edge(const Mesh& mesh) {
  std::vector<double> squares;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      squares.push_back(
          (mesh.points.col(mesh.triangles(i, t)) - mesh.points.col(mesh.triangles((i + 1) % 3, t)))
              .squaredNorm());
  const auto tenth = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 10);
  std::nth_element(squares.begin(), tenth, squares.end());
  return std::sqrt(*tenth);
}

} // namespace

Raster resampled(const Points3& points, const DoubleVector& widths) {
  constexpr double finest = 0.05, coarsest = 1; // degrees
  Mesh mesh = delaunay(points);
  require(mesh.closed(), "the points lie within a hemisphere; give widths on the whole sphere");
  for (auto&& point : mesh.points.colwise())
    point.normalize();
  const double spacing = 2 * arc_sine(0.5 * short_edge(mesh)) * 180 / std::numbers::pi;
  Raster grid = regular_grid(std::clamp(0.5 * spacing, finest, coarsest));
  fill(
      mesh, site_widths(mesh, widths),
      [&](Eigen::Index i, Eigen::Index j) { return from_lonlat(grid.x[i], grid.y[j]); },
      grid.values);
  return grid;
}

Raster resampled_in_plane(const Points2& points, const DoubleVector& widths) {
  constexpr double most_nodes = 4e6;
  const Mesh mesh = delaunay(points, Surface::plane());
  const Eigen::Vector2d low = points.rowwise().minCoeff(), size = points.rowwise().maxCoeff() - low;
  Raster grid = density_detail::grid_over(low, size, 0.5 * short_edge(mesh), most_nodes);
  fill(
      mesh, site_widths(mesh, widths),
      [&](Eigen::Index i, Eigen::Index j) {
        return Vec3{grid.x[i], grid.y[j], 0};
      },
      grid.values);
  return grid;
}

} // namespace calotte::io_detail
