// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "base/points.h"
#include "integrals/moments.h"
#include "quality/cell_measures.h"
#include "quality/demand.h"
#include "quality/flat_hull.h"
#include "quality/planar_quality.h"
#include "quality/sides.h"

#include <calotte/check.h>
#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace calotte {
namespace quality_detail {
namespace {

/// Distance from the constrained centroid over spacing.
void set_centroids(const Mesh& mesh, const Density& density, CellMeasures& out) {
  const Moments moments = mesh_moments(mesh, density);
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    const Vec3 first = moments.first[i];
    out.off_centroid[i] = norm((1 / norm(first)) * first - column(mesh.points, i)) / out.spacing[i];
  }
}

/// Values by triangle of a part of a mesh, for all of its triangles.
DoubleVector of_all(const DoubleVector& values, const std::vector<std::int32_t>& triangle,
                    Eigen::Index triangles) {
  DoubleVector all = DoubleVector::Constant(triangles, no_value);
  all(triangle) = values;
  return all;
}

/// \param mesh without flat triangles along its boundary.
CellMeasures measure_cells(const Mesh& mesh, const Density& density) {
  Subject subject{mesh.triangles, mesh.neighbours, {}, make_shapes(mesh), {}, {}, {}};
  CellMeasures out = unset_measures(mesh.points.cols(), mesh.triangles.cols());
  set_angles(subject, out);
  const EdgeCounts edges = count_edges(mesh);
  const std::vector<Sides> cells = sides_of_cells(mesh, subject.shapes);
  for (Eigen::Index i = 0; i < out.spacing.size(); ++i) {
    const Sides& cell = cells[static_cast<std::size_t>(i)];
    out.spacing[i] = cell.arcs.sum / static_cast<double>(cell.arcs.count);
    if (!cell.whole())
      out.degree[i] = no_value;
    if (!cell.whole() || edges.not_delaunay > 0)
      continue;
    out.sigma[i] = cell.arcs.min / cell.arcs.max;
    out.quality[i] = cell.voronoi.min / cell.voronoi.max;
    out.area[i] = cell.area;
  }
  if (edges.boundary > 0 || edges.not_delaunay > 0)
    return out;
  subject.inverse_spacing = inverse_spacings(mesh.points, density, root_integral(mesh, density));
  set_fits(subject, out);
  set_centroids(mesh, density, out);
  return out;
}

} // namespace
} // namespace quality_detail

CellMeasures cell_measures(const Mesh& mesh, const Density& density) {
  if (!mesh.surface.is_sphere())
    return quality_detail::cell_measures_in_plane(mesh, density);
  evaluate(density, Points3(Eigen::Vector3d::UnitZ())); // throws if the density is ill-formed
  if (const Check found = check_surface(mesh); !found.passed())
    throw Error(ErrorCode::invalid_argument, "the triangles do not form a surface: " +
                                                 found.failure + "; triangulate the points anew");
  using namespace quality_detail;
  const WithoutFlatHull part = without_flat_hull(with_unit_columns(mesh));
  CellMeasures measures = measure_cells(part.mesh, density);
  if (part.mesh.triangles.cols() < mesh.triangles.cols())
    for (DoubleVector* values : {&measures.triangle_angle, &measures.triangle_quality})
      *values = of_all(*values, part.triangle, mesh.triangles.cols());
  return measures;
}

} // namespace calotte
