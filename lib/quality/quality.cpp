// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "base/points.h"
#include "exact/predicates.h"
#include "integrals/moments.h"
#include "quality/demand.h"
#include "quality/parts.h"

#include <calotte/check.h>
#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace calotte {
namespace quality_detail {
namespace {

constexpr double pi = std::numbers::pi;

/// sin(delta) = |a-b|/|a+b| cot(C), as in moments.h.
Shape shape_of(const std::array<Vec3, 3>& p) {
  const double twice_area = norm(cross(p[1] - p[0], p[2] - p[0]));
  Shape shape{};
  for (std::size_t v = 0; v < 3; ++v) {
    const Vec3 a = p[(v + 1) % 3], b = p[(v + 2) % 3];
    const double product = dot(a - p[v], b - p[v]), difference = norm(a - b), sum = norm(a + b);
    const double sine = difference / sum * (product / twice_area);
    shape.angle[v] = std::atan2(twice_area, product);
    shape.side[v] = 2 * std::atan2(difference, sum);
    shape.delta[v] = std::asin(std::clamp(sine, -1.0, 1.0)); // rounding can exceed a hemisphere
  }
  return shape;
}

Shapes make_shapes(const Mesh& mesh) {
  Shapes shapes(mesh.triangles.cols());
  for_each_block(shapes.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      shapes[t] = shape_of({column(mesh.points, mesh.triangles(0, t)),
                            column(mesh.points, mesh.triangles(1, t)),
                            column(mesh.points, mesh.triangles(2, t))});
  });
  return shapes;
}

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

Mesh with_unit_columns(Mesh mesh) {
  for_each_block(mesh.points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3 unit = normalised(column(mesh.points, i));
      mesh.points.col(i) << unit.x, unit.y, unit.z;
    }
  });
  return mesh;
}

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

/// The sides of a cell, as far as triangles surround it.
struct Sides {
  Tally arcs, voronoi; ///< lengths of its Delaunay and Voronoi edges
  double area = 0;
  bool open = false;
  bool bad = false; ///< has a short side, or the centre of an obtuse triangle as a corner
};

/// The part of a triangle that is nearer to one end of a side than to its other vertices, on that
/// side's side of the circumcentre; signed (see Shape::delta).
double half_kite(double side, double delta) {
  return 2 * std::atan(std::tan(side / 4) * std::tan(delta / 2));
}

void add_side(const Mesh& mesh, const Shapes& shapes, std::int64_t t, int v,
              std::vector<Sides>& cells) {
  const std::int32_t other = mesh.neighbours(v, t);
  const auto& [angle, side, delta] = shapes[t];
  const auto corner = static_cast<std::size_t>(v);
  std::optional<Edge> edge;
  if (other > t) {
    const int w = mesh.neighbours(0, other) == t ? 0 : mesh.neighbours(1, other) == t ? 1 : 2;
    edge = edge_of(shapes, t, v, other, w);
  }
  for (const int end : {next_vertex(v), previous_vertex(v)}) {
    Sides& cell = cells[static_cast<std::size_t>(mesh.triangles(end, t))];
    cell.area += half_kite(side[corner], delta[corner]);
    cell.open = cell.open || other < 0;
    cell.bad = cell.bad || is_obtuse(shapes[t]) || (edge && is_short(*edge));
    if (edge) {
      cell.arcs.add(edge->arc);
      cell.voronoi.add(edge->voronoi);
    }
  }
}

/// Measures the cells that triangles surround.
void add_whole_cells(const Mesh& mesh, const Shapes& shapes, Quality& result) {
  std::vector<Sides> cells(static_cast<std::size_t>(mesh.points.cols()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      add_side(mesh, shapes, t, v, cells);
  Tally sigma, quality, area, bad;
  for (const Sides& cell : cells) {
    if (cell.open || cell.arcs.count == 0)
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
  const Mesh unit = with_unit_columns(mesh);
  const Subject subject{unit.triangles, unit.neighbours, {}, make_shapes(unit), {}, {}, {}};
  Quality result = measure_shapes(subject, 0);
  if (cells) {
    add_whole_cells(unit, subject.shapes, result);
  } else {
    result.off_centring = result.dv_over_dc = {};
    result.short_edges = 0;
  }
  result.cells = mesh.points.cols();
  result.degrees = inner_degrees(mesh);
  result.triangles_area = found.area / (4 * pi);
  return result;
}

} // namespace
} // namespace quality_detail

Quality triangle_quality(const Mesh& mesh) { return quality_detail::measure_open(mesh, false); }

Quality open_quality(const Mesh& mesh) { return quality_detail::measure_open(mesh, true); }

} // namespace calotte
