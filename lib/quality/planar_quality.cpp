// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/planar_quality.h"

#include "base/points.h"
#include "base/require.h"
#include "cvt/cells.h"
#include "cvt/cvt.h"
#include "cvt/functional.h"
#include "density/surface_density.h"
#include "domain/clipped_cell.h"
#include "domain/surface.h"
#include "quality/cell_measures.h"
#include "quality/demand.h"
#include "quality/parts.h"
#include "quality/sides.h"
#include "quality/voronoi_mesh.h"

#include <calotte/error.h>
#include <calotte/voronoi.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace quality_detail {
namespace {

/// Computes lengths from each corner, in a box to the nearest copies.
Shape shape_of(const std::array<Vec3, 3>& p, const Plane& plane) {
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

/// Selects the triangles of a domain: their circumcentre is in it, and none of their corners is a
/// place of the hull.
class Insides {
public:
  /// \pre the surface is bounded.
  Insides(const Cells<Plane>& cells, const Surface& surface, std::int64_t generators)
      : cells_(&cells), outline_(*outline_of<Plane>(surface)), generators_(generators) {}

  bool triangle(const Triangles& triangles, std::int64_t t) const {
    if (triangles.col(t).maxCoeff() >= generators_)
      return false;
    const Vec2 centre = at(triangles(0, t)) + centre_of(triangles, t, 0);
    return outline_.side(centre) != Side::outside;
  }
  /// True if the site is inside, and the boundary passes through no interior of its cell.
  bool whole(const Triangles& triangles, const VertexRings& rings, std::int64_t site) const {
    const Vec2 here = at(static_cast<std::int32_t>(site));
    std::vector<CellCorner> cell;
    for (const Corner corner : rings[site])
      cell.push_back({centre_of(triangles, corner.triangle, corner.vertex),
                      at(triangles(previous_vertex(corner.vertex), corner.triangle)) - here});
    if (outline_.side(here) == Side::outside)
      return false;
    if (!near_boundary(outline_, here, cell))
      return true;
    const std::vector<CellSide> sides = clipped_cell(outline_, here, std::move(cell));
    return std::none_of(sides.begin(), sides.end(),
                        [](const CellSide& side) { return side.boundary; });
  }

private:
  Vec2 at(std::int32_t site) const { return {cells_->place(site).x, cells_->place(site).y}; }
  Vec2 centre_of(const Triangles& triangles, std::int64_t t, int v) const {
    const Vec2 here = at(triangles(v, t));
    return circumcentre(at(triangles(next_vertex(v), t)) - here,
                        at(triangles(previous_vertex(v), t)) - here);
  }

  const Cells<Plane>* cells_;
  const Outline& outline_;
  std::int64_t generators_;
};

/// For each of n generators 1 if the boundary does not clip its cell, otherwise 0.
/// \param mesh of the generators and the hull; \param rings of the generators.
Array<std::uint8_t> whole_cells(const Insides& insides, const Connectivity& mesh,
                                const VertexRings& rings, std::int64_t n) {
  Array<std::uint8_t> whole(n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      whole[i] = insides.whole(mesh.triangles, rings, i) ? 1 : 0;
  });
  return whole;
}

/// For each triangle 1 if it is one of the domain's, otherwise 0.
Array<std::uint8_t> triangles_inside(const Insides& insides, const Triangles& triangles) {
  Array<std::uint8_t> inside(triangles.cols());
  for_each_block(inside.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      inside[t] = insides.triangle(triangles, t) ? 1 : 0;
  });
  return inside;
}

/// The shapes of triangles. \param place of a point by its id.
template <class Place>
Shapes shapes_of(const Triangles& triangles, const Plane& plane, const Place& place) {
  Shapes shapes(triangles.cols());
  for_each_block(shapes.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      shapes[t] =
          shape_of({place(triangles(0, t)), place(triangles(1, t)), place(triangles(2, t))}, plane);
  });
  return shapes;
}

/// \param mesh of the n generators and the hull.
/// \param inverse_spacing by generator.
Quality measure(const Cells<Plane>& cells, const Connectivity& mesh, const Surface& surface,
                std::int64_t n, DoubleVector&& inverse_spacing) {
  Subject subject{mesh.triangles,
                  mesh.neighbours,
                  make_vertex_rings(mesh.triangles, mesh.neighbours, n),
                  shapes_of(mesh.triangles, cells.space(),
                            [&](std::int32_t place) { return cells.place(place); }),
                  std::move(inverse_spacing),
                  {},
                  {}};
  if (!surface.is_bounded())
    return measure_shapes(subject, n);
  const Insides insides(cells, surface, n);
  subject.inside = triangles_inside(insides, mesh.triangles);
  subject.whole = whole_cells(insides, mesh, subject.rings, n);
  return measure_shapes(subject, n);
}

/// The evaluation of a density.
/// \param mesh of the generators and the hull.
Evaluation evaluated(const Points3& points, const Connectivity& mesh, const Surface& surface,
                     const Density& density, int rule = 6, int divisions = 1) {
  CvtOptions options;
  options.density = density;
  options.final_rule = rule;
  options.divisions = divisions;
  Level level;
  level.mesh = mesh;
  const std::unique_ptr<Functional> functional =
      make_functional(points, surface, options, std::move(level));
  Evaluation result;
  functional->evaluate(points, true, true, result);
  functional->set_centroids(points, result, result.centroids);
  return result;
}

/// The integral of rho^(1/2) over the domain. Errors of 1e-6 remain with few points a cell, if
/// there are many cells: in the sum most of them cancel.
double root_integral(const Points3& points, const Connectivity& mesh, const Surface& surface,
                     const Density& planar) {
  if (planar.uniform())
    return surface.area();
  constexpr Eigen::Index many = 10000;
  const bool few = points.cols() < many;
  double sum = 0;
  for (const double mass :
       evaluated(points, mesh, surface, site_density(planar), few ? 6 : 3, few ? 2 : 1).mass)
    sum += mass;
  return sum;
}

void require_mesh(const Mesh& mesh) {
  require_finite_plane(mesh.surface);
  require_voronoi_mesh(mesh);
  require_inside(mesh.points, mesh.surface);
}

/// Sets the measures of clipped cells, too. \param cells clipped by the domain.
void set_sides(const Voronoi& cells, CellMeasures& out) {
  for (Eigen::Index i = 0; i < out.spacing.size(); ++i) {
    Tally arcs, voronoi;
    bool whole = true;
    for (const std::int32_t edge : cells.edges_on_cell[i]) {
      if (cells.cells_on_edge(1, edge) < 0) {
        whole = false;
        continue;
      }
      arcs.add(cells.dc[edge]);
      voronoi.add(cells.dv[edge]);
    }
    out.area[i] = cells.cell_area[i];
    out.spacing[i] = arcs.range().mean;
    out.degree[i] = whole ? static_cast<double>(arcs.count) : no_value;
    out.sigma[i] = whole ? arcs.min / arcs.max : no_value;
    out.quality[i] = whole ? voronoi.min / voronoi.max : no_value;
  }
}

} // namespace
} // namespace quality_detail

CellMeasures quality_detail::cell_measures_in_plane(const Mesh& mesh, const Density& density) {
  require_mesh(mesh);
  const Surface& surface = mesh.surface;
  const Density planar = surface_density(density, surface);
  const Points3& points = mesh.points;
  Cells<Plane> cells(mesh.surface);
  cells.move(points);
  const Connectivity closed = cells.triangulate();
  const double root = root_integral(points, closed, surface, planar);
  Subject subject{mesh.triangles,
                  mesh.neighbours,
                  {},
                  shapes_of(mesh.triangles, cells.space(),
                            [&](std::int32_t site) { return column(points, site); }),
                  inverse_spacings(points, planar, root),
                  {},
                  {}};
  if (surface.is_bounded())
    subject.inside = triangles_inside(Insides(cells, surface, points.cols()), mesh.triangles);
  CellMeasures out = unset_measures(points.cols(), mesh.triangles.cols());
  set_angles(subject, out);
  set_fits(subject, out);
  set_sides(voronoi(mesh), out);
  const Points3 centroids = evaluated(points, closed, surface, planar).centroids;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    out.off_centroid[i] =
        norm(cells.offset(column(points, i), column(centroids, i))) / out.spacing[i];
  return out;
}

Quality quality_detail::quality_in_plane(const Mesh& mesh, const Density& density) {
  require_mesh(mesh);
  const Surface& surface = mesh.surface;
  const Density planar = surface_density(density, surface);
  const Points3& points = mesh.points;
  Cells<Plane> cells(mesh.surface);
  cells.move(points);
  const Connectivity closed = cells.triangulate();
  const Evaluation uniform = evaluated(points, closed, surface, Density{}),
                   of_density = density.uniform() ? Evaluation{}
                                                  : evaluated(points, closed, surface, planar);
  const CvtIteration& measured = (density.uniform() ? uniform : of_density).iteration;
  const double root = root_integral(points, closed, surface, planar);
  Quality result =
      measure(cells, closed, surface, points.cols(), inverse_spacings(points, planar, root));
  Tally areas;
  for (const double cell : uniform.mass)
    areas.add(cell);
  result.cell_area = areas.range();
  result.residual = measured.l2 / measured.spacing;
  set_energy(result, measured.energy, root);
  result.cells_area = areas.sum / surface.area();
  return result;
}

Quality quality_detail::measure_open_plane(const Mesh& mesh, bool cells) {
  if (const Check found = check_surface(mesh); !found.passed())
    throw Error(ErrorCode::invalid_argument, "the triangles do not form a surface: " +
                                                 found.failure + "; triangulate the points anew");
  const Subject subject{mesh.triangles,
                        mesh.neighbours,
                        {},
                        shapes_of(mesh.triangles, Plane(mesh.surface.period()),
                                  [&](std::int32_t site) { return column(mesh.points, site); }),
                        {},
                        {},
                        {}};
  Quality result = measure_shapes(subject, 0);
  const std::vector<Sides> sides = sides_of_cells(mesh, subject.shapes);
  if (cells) {
    set_whole_cells(sides, result);
  } else {
    result.off_centring = result.dv_over_dc = {};
    result.short_edges = 0;
  }
  result.cells = mesh.points.cols();
  result.degrees = inner_degrees(sides);
  return result;
}

std::vector<bool> clipped_cells(const Mesh& mesh) {
  const Surface& surface = mesh.surface;
  if (surface.is_whole_sphere())
    return std::vector<bool>(static_cast<std::size_t>(mesh.points.cols()));
  quality_detail::require(
      !surface.is_sphere(),
      "the mesh is one of a region of the sphere, which clips no cells; give one "
      "of the plane or of the whole sphere");
  using namespace quality_detail;
  require_finite_plane(surface);
  const std::int64_t n = mesh.points.cols();
  std::vector<bool> clipped(static_cast<std::size_t>(n));
  if (!surface.is_bounded() || n == 0)
    return clipped;
  Cells<Plane> cells(mesh.surface);
  cells.move(mesh.points);
  const Connectivity closed = cells.triangulate();
  const Array<std::uint8_t> whole =
      whole_cells(Insides(cells, surface, n), closed,
                  make_vertex_rings(closed.triangles, closed.neighbours, n), n);
  for (std::size_t i = 0; i < clipped.size(); ++i)
    clipped[i] = whole[static_cast<std::int64_t>(i)] == 0;
  return clipped;
}

} // namespace calotte
