// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "base/points.h"
#include "integrals/moments.h"
#include "quality/demand.h"
#include "quality/flat_hull.h"
#include "quality/planar_quality.h"
#include "quality/sides.h"
#include "quality/voronoi_mesh.h"

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
  const Check found = require_voronoi_mesh(mesh);
  if (found.boundary_edges > 0)
    throw Error(ErrorCode::invalid_argument,
                "the mesh is open, as all its sites lie in a hemisphere, and its Voronoi cells do "
                "not tessellate the sphere: give sites all around");
  return found.area;
}

Quality measure(const Mesh& mesh, const Density& density) {
  const MomentPart moments = add_moments(mesh, density);
  if (const std::int64_t i = moments.without_centroid; i >= 0)
    throw Error(ErrorCode::invalid_argument,
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
  if (!mesh.surface.is_sphere())
    return quality_detail::quality_in_plane(mesh, density);
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
  if (!mesh.surface.is_sphere())
    return measure_open_plane(mesh, cells);
  const Check found = check_surface(mesh);
  if (!found.passed())
    throw Error(ErrorCode::invalid_argument, "the triangles do not form a surface: " +
                                                 found.failure + "; triangulate the points anew");
  const Mesh unit = without_flat_hull(with_unit_columns(mesh)).mesh;
  const Subject subject{unit.triangles, unit.neighbours, {}, make_shapes(unit), {}, {}, {}};
  Quality result = measure_shapes(subject, 0);
  const std::vector<Sides> sides = sides_of_cells(unit, subject.shapes);
  if (cells) {
    result.cells_area = set_whole_cells(sides, result) / (4 * pi);
  } else {
    result.off_centring = result.dv_over_dc = {};
    result.short_edges = 0;
  }
  result.cells = mesh.points.cols();
  result.flat = mesh.triangles.cols() - unit.triangles.cols();
  result.degrees = inner_degrees(sides);
  result.triangles_area = found.area / (4 * pi);
  return result;
}

} // namespace
} // namespace quality_detail

Quality triangle_quality(const Mesh& mesh) { return quality_detail::measure_open(mesh, false); }

Quality open_quality(const Mesh& mesh) { return quality_detail::measure_open(mesh, true); }

} // namespace calotte
