// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "base/points.h"
#include "integrals/moments.h"
#include "quality/demand.h"
#include "quality/flat_hull.h"
#include "quality/sides.h"

#include <calotte/check.h>
#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace calotte {
namespace quality_detail {
namespace {

constexpr double pi = std::numbers::pi;

// ---- Moments

struct MomentPart {
  Tally area;
  double energy = 0, squares = 0;
  std::int64_t without_centroid = -1; ///< the first such site

  void join(const MomentPart& other) {
    area.join(other.area);
    energy += other.energy;
    squares += other.squares;
    if (without_centroid < 0)
      without_centroid = other.without_centroid;
  }
};

MomentPart add_moments(const Mesh& mesh, const Density& density) {
  const Moments uniform = mesh_moments(mesh, Density{});
  Moments of_density;
  if (!density.uniform())
    of_density = mesh_moments(mesh, density);
  const Moments& moments = density.uniform() ? uniform : of_density;
  return join_blocks<MomentPart>(mesh.points.cols(), [&](MomentPart& part, std::int64_t i) {
    const double length = norm(moments.first[i]);
    if (part.without_centroid < 0 && !(length > 0 && std::isfinite(length)))
      part.without_centroid = i;
    const Vec3 apart = (1 / length) * moments.first[i] - column(mesh.points, i);
    part.area.add(uniform.mass[i]);
    part.energy += moments.energy[i];
    part.squares += dot(apart, apart);
  });
}

// ---- Input validation

/// \returns the sum of the triangles' areas.
double require_closed_delaunay(const Mesh& mesh) {
  Check found = check(mesh);
  if (!found.passed()) {
    // The other diagonals of cocircular sites make the same cells.
    const std::string failure = found.failure;
    found = check_surface(mesh);
    const EdgeCounts edges = found.passed() ? count_edges(mesh) : EdgeCounts{};
    if (edges.boundary > 0 || edges.unused_sites > 0 || edges.cocircular == 0 ||
        edges.not_delaunay > 0)
      throw Error(ErrorCode::bad_option,
                  "the mesh is not the Delaunay triangulation of its points, so it has no Voronoi "
                  "cells: " +
                      failure + "; triangulate the points anew");
  }
  if (found.boundary_edges > 0)
    throw Error(ErrorCode::bad_option,
                "the mesh is open, as all its sites lie in a hemisphere, and its Voronoi cells do "
                "not tessellate the sphere: give sites all around");
  return found.area;
}

/// How many sites with a closed ring of triangles have each number of neighbours.
std::vector<std::int64_t> inner_degrees(const Mesh& mesh) {
  std::vector<std::int64_t> degree(static_cast<std::size_t>(mesh.points.cols()));
  std::vector<bool> open(degree.size());
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      ++degree[static_cast<std::size_t>(mesh.triangles(i, t))];
      if (mesh.neighbours(i, t) < 0)
        for (const int end : {1, 2})
          open[static_cast<std::size_t>(mesh.triangles((i + end) % 3, t))] = true;
    }
  CellPart inner;
  for (std::size_t i = 0; i < degree.size(); ++i)
    if (!open[i] && degree[i] > 0)
      inner.count(static_cast<std::size_t>(degree[i]), 1);
  return inner.degrees;
}

// ---- Open meshes

/// Measures the cells that triangles surround.
void add_whole_cells(const Mesh& mesh, const Shapes& shapes, Quality& result) {
  Tally sigma, quality, area, bad;
  for (const Sides& cell : sides_of_cells(mesh, shapes)) {
    if (!cell.whole())
      continue;
    sigma.add(cell.arcs.min / cell.arcs.max);
    quality.add(cell.voronoi.min / cell.voronoi.max);
    area.add(cell.area);
    if (cell.bad)
      bad.add(cell.arcs.sum / static_cast<double>(cell.arcs.count));
  }
  result.sigma = sigma.range();
  result.cell_quality = quality.range();
  result.cell_area = area.range();
  result.bad_cells = bad.count;
  result.bad_spacing = bad.range();
  result.cells_area = area.sum / (4 * pi);
}

Quality measure(const Mesh& mesh, const Density& density) {
  const MomentPart moments = add_moments(mesh, density);
  if (const std::int64_t i = moments.without_centroid; i >= 0)
    throw Error(ErrorCode::bad_option,
                "the density is zero over the whole cell of site " + std::to_string(i) +
                    ": make it positive everywhere",
                i);
  const double root = root_integral(mesh, density);
  Quality result = measure_shapes({mesh.triangles,
                                   mesh.neighbours,
                                   make_vertex_rings(mesh),
                                   make_shapes(mesh),
                                   inverse_spacings(mesh.points, density, root),
                                   {},
                                   {}},
                                  mesh.points.cols());
  result.cell_area = moments.area.range();
  result.residual = std::sqrt(moments.squares / (4 * pi)); // sqrt(squares/n) over sqrt(4 pi/n)
  set_energy(result, moments.energy, root);
  result.cells_area = moments.area.sum / (4 * pi);
  return result;
}

} // namespace
} // namespace quality_detail

Quality quality(const Mesh& mesh, const Density& density) {
  evaluate(density, Points3(Eigen::Vector3d::UnitZ())); // throws if the density is ill-formed
  const double triangles_area = quality_detail::require_closed_delaunay(mesh);
  Quality result = quality_detail::measure(quality_detail::with_unit_columns(mesh), density);
  result.triangles_area = triangles_area / (4 * std::numbers::pi);
  return result;
}

namespace quality_detail {
namespace {

/// \param cells whether the Voronoi cells are measured, too.
Quality measure_open(const Mesh& mesh, bool cells) {
  const Check found = check_surface(mesh);
  if (!found.passed())
    throw Error(ErrorCode::bad_option, "the triangles do not form a surface: " + found.failure +
                                           "; triangulate the points anew");
  const Mesh unit = without_flat_hull(with_unit_columns(mesh)).mesh;
  const Subject subject{unit.triangles, unit.neighbours, {}, make_shapes(unit), {}, {}, {}};
  Quality result = measure_shapes(subject, 0);
  if (cells) {
    add_whole_cells(unit, subject.shapes, result);
  } else {
    result.off_centring = result.dv_over_dc = {};
    result.short_edges = 0;
  }
  result.cells = mesh.points.cols();
  result.flat = mesh.triangles.cols() - unit.triangles.cols();
  result.degrees = inner_degrees(unit);
  result.triangles_area = found.area / (4 * pi);
  return result;
}

} // namespace
} // namespace quality_detail

Quality triangle_quality(const Mesh& mesh) { return quality_detail::measure_open(mesh, false); }

Quality open_quality(const Mesh& mesh) { return quality_detail::measure_open(mesh, true); }

} // namespace calotte
