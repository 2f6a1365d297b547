// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "base/points.h"
#include "base/require.h"
#include "density/surface_density.h"
#include "domain/surface.h"
#include "quality/closed_mesh.h"
#include "quality/demand.h"
#include "quality/flat_hull.h"
#include "quality/sides.h"
#include "quality/voronoi_mesh.h"

#include <calotte/check.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace calotte {
namespace quality_detail {
namespace {

constexpr double sphere_area = 4 * std::numbers::pi;

/// Checks the cells of a mesh. \returns the sum of the triangles' areas.
double require_cells(const Mesh& mesh) {
  if (!mesh.surface.is_sphere())
    require_finite_plane(mesh.surface);
  const CheckReport found = require_voronoi_mesh(mesh);
  if (!mesh.surface.is_sphere())
    require_inside(mesh.points, mesh.surface);
  else
    require(found.boundary_edges == 0,
            "the mesh is open, as all its sites lie in a hemisphere, and its Voronoi cells do not "
            "tessellate the sphere: give sites all around");
  return found.area;
}

// ---- Moments

struct MomentPart {
  Tally area;
  double energy = 0, squares = 0;

  void join(const MomentPart& other) {
    area.join(other.area);
    energy += other.energy;
    squares += other.squares;
  }
};

MomentPart add_moments(const ClosedMesh& closed, const Density& density) {
  const Moments uniform = moments_of(closed, Density{});
  Moments of_density;
  if (!density.uniform())
    of_density = moments_of(closed, density);
  const Moments& moments = density.uniform() ? uniform : of_density;
  for (std::int64_t i = 0; i < closed.generators && !density.uniform(); ++i)
    require_centroid(closed, moments, i);
  return join_blocks<MomentPart>(closed.generators, [&](MomentPart& part, std::int64_t i) {
    const Vec3 apart = off_centroid(closed, moments, i);
    part.area.add(uniform.mass[i]);
    part.energy += moments.energy[i];
    part.squares += dot(apart, apart);
  });
}

Quality measure(const ClosedMesh& closed, const Density& density) {
  const MomentPart moments = add_moments(closed, density);
  const double root = root_integral(closed, density), area = closed.surface.area();
  const Mesh& mesh = closed.mesh;
  Subject subject{mesh.triangles,
                  mesh.neighbours,
                  make_vertex_rings(mesh.triangles, mesh.neighbours, closed.generators),
                  make_shapes(mesh),
                  inverse_spacings(mesh.points.leftCols(closed.generators), density, root),
                  triangles_inside(closed, mesh.triangles),
                  {}};
  subject.whole = unclipped_cells(closed, subject.rings);
  Quality result = measure_shapes(subject, closed.generators);
  result.cell_area = moments.area.range();
  result.residual = std::sqrt(moments.squares / area); // sqrt(squares/n) over sqrt(area/n)
  set_energy(result, moments.energy, root);
  result.cells_area = moments.area.sum / area;
  return result;
}

/// \param cells whether to measure the Voronoi cells, too.
Quality quality_of_open(const Mesh& mesh, bool cells) {
  const CheckReport found = require_surface(mesh);
  const bool on_sphere = mesh.surface.is_sphere();
  std::optional<Mesh> unit;
  if (on_sphere)
    unit = without_flat_hull(with_unit_columns(mesh)).mesh;
  const Mesh& part = unit ? *unit : mesh;
  const Subject subject{part.triangles, part.neighbours, {}, make_shapes(part), {}, {}, {}};
  Quality result = measure_shapes(subject, 0);
  const std::vector<Sides> sides = sides_of_cells(part, subject.shapes);
  if (cells) {
    const double area = set_whole_cells(sides, result);
    result.cells_area = on_sphere ? area / sphere_area : 0;
  } else {
    result.off_centring = result.dv_over_dc = {};
    result.short_edges = 0;
  }
  result.cells = mesh.points.cols();
  result.flat = mesh.triangles.cols() - part.triangles.cols();
  result.degrees = inner_degrees(sides);
  result.triangles_area = on_sphere ? found.area / sphere_area : 0;
  return result;
}

} // namespace
} // namespace quality_detail

Quality quality(const Mesh& mesh, const Density& density) {
  using namespace quality_detail;
  const Density on_surface = checked_surface_density(density, mesh.surface);
  const double triangles_area = require_cells(mesh);
  Quality result = measure(mesh.surface.is_sphere() ? closed_on_sphere(with_unit_columns(mesh))
                                                    : closed_in_plane(mesh),
                           on_surface);
  result.triangles_area = mesh.surface.is_sphere() ? triangles_area / sphere_area : 0;
  return result;
}

Quality triangle_quality(const Mesh& mesh) { return quality_detail::quality_of_open(mesh, false); }

Quality open_quality(const Mesh& mesh) { return quality_detail::quality_of_open(mesh, true); }

} // namespace calotte
