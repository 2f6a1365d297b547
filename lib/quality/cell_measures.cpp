// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "density/surface_density.h"
#include "domain/surface.h"
#include "quality/closed_mesh.h"
#include "quality/demand.h"
#include "quality/flat_hull.h"
#include "quality/sides.h"
#include "quality/voronoi_mesh.h"

#include <calotte/check.h>
#include <calotte/quality.h>
#include <calotte/voronoi.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace calotte {
namespace quality_detail {
namespace {

/// Measures of n cells and m triangles. None is set except the degrees, which are 0.
CellMeasures unset_measures(Eigen::Index n, Eigen::Index m) {
  CellMeasures out;
  out.spacing = DoubleVector::Constant(n, no_value);
  out.area = out.sigma = out.quality = out.largest_angle = out.off_centroid = out.spacing;
  out.degree = DoubleVector::Zero(n);
  out.triangle_angle = out.triangle_quality = DoubleVector::Constant(m, no_value);
  return out;
}

/// Sets the measures of triangles: their angles and quality, and by site the number of triangles
/// and their largest angle.
void set_angles(const Subject& subject, CellMeasures& out) {
  constexpr double degrees = 180 / std::numbers::pi;
  for (std::int64_t t = 0; t < subject.shapes.size(); ++t) {
    if (!subject.has(t))
      continue;
    TrianglePart part;
    add_triangle(part, subject.shapes[t]);
    out.triangle_angle[t] = degrees * part.angles.max;
    out.triangle_quality[t] = part.quality.max;
    for (const std::int32_t site : subject.triangles.col(t)) {
      ++out.degree[site];
      out.largest_angle[site] = std::fmax(out.largest_angle[site], out.triangle_angle[t]);
    }
  }
}

/// Sets the spacings that the density prescribes, and the least and the greatest dc/h at each site.
void set_fits(const Subject& subject, CellMeasures& out) {
  out.prescribed = subject.inverse_spacing.cwiseInverse();
  out.min_dc_over_h = DoubleVector::Constant(out.prescribed.size(), no_value);
  out.max_dc_over_h = out.min_dc_over_h;
  for (std::int64_t t = 0; t < subject.shapes.size(); ++t)
    for (int v = 0; v < 3 && subject.has(t); ++v) {
      const double fit = subject.fit(t, v);
      for (const int end : {next_vertex(v), previous_vertex(v)}) {
        const std::int32_t site = subject.triangles(end, t);
        out.min_dc_over_h[site] = std::fmin(out.min_dc_over_h[site], fit);
        out.max_dc_over_h[site] = std::fmax(out.max_dc_over_h[site], fit);
      }
    }
}

/// Sets the measures of cells that are surrounded by triangles.
/// \param delaunay whether all edges are Delaunay.
void set_surrounded(const std::vector<Sides>& cells, bool delaunay, CellMeasures& out) {
  for (Eigen::Index i = 0; i < out.spacing.size(); ++i) {
    const Sides& cell = cells[static_cast<std::size_t>(i)];
    out.spacing[i] = cell.arcs.sum / static_cast<double>(cell.arcs.count);
    if (!cell.whole())
      out.degree[i] = no_value;
    if (!cell.whole() || !delaunay)
      continue;
    out.sigma[i] = cell.arcs.min / cell.arcs.max;
    out.quality[i] = cell.voronoi.min / cell.voronoi.max;
    out.area[i] = cell.area;
  }
}

/// Sets the measures of cells of the plane, which a boundary may clip.
void set_clipped(const Voronoi& cells, CellMeasures& out) {
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

/// Sets the demand of the density, and the distances of generators from the centroids of their
/// cells.
void set_demand(const ClosedMesh& closed, const Density& density, Subject& subject,
                CellMeasures& out) {
  const Points3& points = closed.mesh.points;
  subject.inverse_spacing =
      inverse_spacings(points.leftCols(closed.generators), density, root_integral(closed, density));
  set_fits(subject, out);
  const Moments moments = moments_of(closed, density);
  for (std::int64_t i = 0; i < closed.generators; ++i) {
    if (std::isnan(out.spacing[i])) // a site in no triangle
      continue;
    require_centroid(closed, moments, i);
    out.off_centroid[i] = norm(off_centroid(closed, moments, i)) / out.spacing[i];
  }
}

/// Extends values by triangle of a part of a mesh to all of its triangles.
DoubleVector of_all(const DoubleVector& values, const std::vector<std::int32_t>& triangle,
                    Eigen::Index triangles) {
  DoubleVector all = DoubleVector::Constant(triangles, no_value);
  all(triangle) = values;
  return all;
}

/// \param mesh without flat triangles along its boundary.
CellMeasures measure_on_sphere(const Mesh& mesh, const Density& density) {
  Subject subject{mesh.triangles, mesh.neighbours, {}, make_shapes(mesh), {}, {}, {}};
  CellMeasures out = unset_measures(mesh.points.cols(), mesh.triangles.cols());
  set_angles(subject, out);
  const EdgeCounts edges = count_edges(mesh);
  set_surrounded(sides_of_cells(mesh, subject.shapes), edges.not_delaunay == 0, out);
  if (edges.boundary == 0 && edges.not_delaunay == 0)
    set_demand(closed_on_sphere(mesh), density, subject, out);
  return out;
}

CellMeasures measure_in_plane(const Mesh& mesh, const Density& density) {
  require_finite_plane(mesh.surface);
  require_voronoi_mesh(mesh);
  require_inside(mesh.points, mesh.surface);
  const ClosedMesh closed = closed_in_plane(mesh);
  Subject subject{mesh.triangles,
                  mesh.neighbours,
                  {},
                  make_shapes(mesh),
                  {},
                  triangles_inside(closed, mesh.triangles),
                  {}};
  CellMeasures out = unset_measures(mesh.points.cols(), mesh.triangles.cols());
  set_angles(subject, out);
  set_clipped(voronoi(mesh), out);
  set_demand(closed, density, subject, out);
  return out;
}

} // namespace
} // namespace quality_detail

CellMeasures cell_measures(const Mesh& mesh, const Density& density) {
  using namespace quality_detail;
  const Density on_surface = checked_surface_density(density, mesh.surface);
  if (!mesh.surface.is_sphere())
    return measure_in_plane(mesh, on_surface);
  require_surface(mesh);
  const WithoutFlatHull part = without_flat_hull(with_unit_columns(mesh));
  CellMeasures measures = measure_on_sphere(part.mesh, on_surface);
  if (part.mesh.triangles.cols() < mesh.triangles.cols())
    for (DoubleVector* values : {&measures.triangle_angle, &measures.triangle_quality})
      *values = of_all(*values, part.triangle, mesh.triangles.cols());
  return measures;
}

} // namespace calotte
