// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/sides.h"

#include "base/points.h"
#include "exact/predicates.h"
#include "exact/space.h"
#include "mesh/connectivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace calotte::quality_detail {
namespace {

/// The shape of a triangle of the sphere, by sin(delta) = |a-b|/|a+b| cot(C), see kites.h.
Shape shape_of(const Sphere&, const std::array<Vec3, 3>& p) {
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

/// The shape of a triangle of the plane; in a periodic plane, lengths are to the nearest copies.
Shape shape_of(const Plane& plane, const std::array<Vec3, 3>& p) {
  Shape shape{};
  for (std::size_t v = 0; v < 3; ++v) {
    const Vec3 a = plane.offset(p[v], p[(v + 1) % 3]), b = plane.offset(p[v], p[(v + 2) % 3]);
    const double twice_area = cross(a, b).z, product = a.x * b.x + a.y * b.y;
    shape.angle[v] = std::atan2(twice_area, product);
    shape.side[v] = norm(a - b);
    shape.delta[v] = shape.side[v] / 2 * (product / twice_area);
  }
  return shape;
}

/// The signed area (see Shape::delta) of half a kite: the part of a triangle between a side and the
/// circumcentre that is nearest to one end of the side.
double half_kite(const Surface& surface, double side, double delta) {
  return surface.is_sphere() ? 2 * std::atan(std::tan(side / 4) * std::tan(delta / 2))
                             : side / 2 * delta / 2;
}

/// Adds a side of a triangle to the cells of its two ends, and its edge, unless the other triangle
/// has added it.
void add_side(const Mesh& mesh, const Shapes& shapes, std::int64_t t, int v,
              std::vector<Sides>& cells) {
  const std::int32_t other = mesh.neighbours(v, t);
  const auto& [angle, side, delta] = shapes[t];
  const auto corner = static_cast<std::size_t>(v);
  std::optional<Edge> edge;
  if (other > t) {
    const int w = mesh_detail::vertex_across(mesh.neighbours, other, t);
    edge = edge_of(shapes[t], v, shapes[other], w);
  }
  for (const int end : {next_vertex(v), previous_vertex(v)}) {
    Sides& cell = cells[static_cast<std::size_t>(mesh.triangles(end, t))];
    cell.area += half_kite(mesh.surface, side[corner], delta[corner]);
    cell.open = cell.open || other < 0;
    cell.bad = cell.bad || is_obtuse(shapes[t]) || (edge && is_short(*edge));
    if (edge || other < 0)
      cell.arcs.add(side[corner]);
    if (edge)
      cell.voronoi.add(edge->voronoi);
  }
}

} // namespace

Mesh with_unit_columns(Mesh mesh) {
  for_each_block(mesh.points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3 unit = normalised(column(mesh.points, i));
      mesh.points.col(i) << unit.x, unit.y, unit.z;
    }
  });
  return mesh;
}

Shape make_shape(const Mesh& mesh, std::int64_t t) {
  return in_space_of(mesh.surface, [&](const Space auto& space) {
    return shape_of(space, {column(mesh.points, mesh.triangles(0, t)),
                            column(mesh.points, mesh.triangles(1, t)),
                            column(mesh.points, mesh.triangles(2, t))});
  });
}

Shapes make_shapes(const Mesh& mesh) {
  Shapes shapes(mesh.triangles.cols());
  for_each_block(shapes.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      shapes[t] = make_shape(mesh, t);
  });
  return shapes;
}

std::vector<Sides> sides_of_cells(const Mesh& mesh, const Shapes& shapes) {
  std::vector<Sides> cells(static_cast<std::size_t>(mesh.points.cols()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      add_side(mesh, shapes, t, v, cells);
  return cells;
}

double set_whole_cells(const std::vector<Sides>& cells, Quality& result) {
  Tally sigma, quality, area, bad;
  for (const Sides& cell : cells) {
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
  return area.sum;
}

std::vector<std::int64_t> inner_degrees(const std::vector<Sides>& cells) {
  CellPart inner;
  for (const Sides& cell : cells)
    if (cell.whole())
      inner.count(static_cast<std::size_t>(cell.arcs.count), 1);
  return inner.degrees;
}

} // namespace calotte::quality_detail
