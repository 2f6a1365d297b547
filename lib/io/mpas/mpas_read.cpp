// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "io/cells/dual.h"
#include "io/cells/field_order.h"
#include "io/cells/mesh_intake.h"
#include "io/cells/netcdf_fields.h"
#include "io/cells/polygons.h"
#include "io/mpas/mpas.h"
#include "io/mpas/vertex_order.h"
#include "io/netcdf/cf_values.h"
#include "io/netcdf/netcdf_reader.h"

#include "base/parallel.h"
#include "base/points.h"
#include "domain/surface.h"
#include "exact/predicates.h"
#include "exact/space.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte::io_detail {
namespace {

/// Reads the coordinates of cells, edges or vertices, one row at a time. All rows must have the
/// same length.
Points3 read_coordinates(const NetcdfReader& file, const MpasKind& kind) {
  Points3 points;
  for (int row = 0; row < 3; ++row) {
    const std::string name = kind.axis(row);
    const std::vector<double> values =
        file.doubles(name, {row == 0 ? std::int64_t{-1} : std::int64_t{points.cols()}});
    if (row == 0)
      points.resize(3, std::ssize(values));
    points.row(row) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), std::ssize(values));
  }
  return points;
}

/// Reads ids and converts them to 0-based ones, -1 for a missing one.
/// \throws Error parse, for ids out of range.
std::vector<std::int32_t> read_ids(const NetcdfReader& file, const std::string& variable,
                                   const std::vector<std::int64_t>& shape, const std::string& row,
                                   std::int64_t width, const std::string& thing,
                                   std::int64_t count) {
  std::vector<std::int32_t> ids = file.ints(variable, shape);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (ids[k] < 0 || ids[k] > count)
      file.fail("{} has {} {} at {} {} (both 1-based), but there are {}; make the file again",
                variable, thing, ids[k], row, static_cast<std::int64_t>(k) / width + 1, count);
    --ids[k];
  }
  return ids;
}

/// The triangles of the vertices with three cells, and the vertex of each.
struct CompleteVertices {
  Triangles triangles;
  std::vector<std::int32_t> vertex;
  bool all = true;
};

CompleteVertices complete_vertices(const NetcdfReader& file, std::int64_t cells) {
  const std::vector<std::int32_t> ids =
      read_ids(file, mpas::cells_on_vertex, {-1, 3}, "vertex", 3, "cell", cells);
  const Eigen::Map<const Triangles> around(ids.data(), 3, std::ssize(ids) / 3);
  CompleteVertices complete{Triangles(3, around.cols()), {}, true};
  for (std::int32_t v = 0; v < around.cols(); ++v)
    if (around.col(v).minCoeff() >= 0) {
      complete.triangles.col(std::ssize(complete.vertex)) = around.col(v);
      complete.vertex.push_back(v);
    }
  complete.all = std::ssize(complete.vertex) == around.cols();
  complete.triangles.conservativeResize(Eigen::NoChange, std::ssize(complete.vertex));
  return complete;
}

/// Whether each vertex is the circumcentre of its cells: within a millionth of the mean cell width,
/// or of the distance of the circumcentre from the cells, whichever is larger.
bool are_cell_corners(const Points3& sites, const Triangles& triangles, const Points3& vertices,
                      double rounding) {
  return are_circumcentres(sites, triangles, vertices,
                           corner_tolerance(mean_width(sites.cols()), rounding), 1e-6);
}

/// Reads the cells. A cell with a missing vertex gets no vertices.
Polygons read_polygons(const NetcdfReader& file, Points3 sites, Points3 vertices) {
  const std::int64_t cells = sites.cols();
  const std::vector<std::int32_t> counts = file.ints(mpas::n_edges_on_cell, {cells});
  const std::int64_t width = file.shape_of(mpas::vertices_on_cell).back();
  const std::vector<std::int32_t> rows =
      read_ids(file, mpas::vertices_on_cell, {cells, -1}, "cell", width, "vertex", vertices.cols());
  Polygons polygons{std::move(vertices), {Offsets(cells + 1), {}}, std::move(sites)};
  std::vector<std::int32_t> ids;
  for (std::int64_t i = 0; i < cells; ++i) {
    polygons.ids.begin[i] = std::ssize(ids);
    const std::int64_t count = counts[static_cast<std::size_t>(i)];
    if (count < 0 || count > width)
      file.fail(
          "nEdgesOnCell is {} at cell {} (1-based), but verticesOnCell holds {}; make the file "
          "again",
          count, i + 1, width);
    const auto first = rows.begin() + i * width;
    if (std::all_of(first, first + count, [](std::int32_t id) { return id >= 0; }))
      ids.insert(ids.end(), first, first + count);
  }
  polygons.ids.begin[cells] = std::ssize(ids);
  polygons.ids.items = Eigen::Map<const Ids>(ids.data(), std::ssize(ids));
  return polygons;
}

void select_vertices(std::vector<MeshField>& fields, const std::vector<std::int32_t>& vertices) {
  for (MeshField& field : fields)
    if (field.location == FieldLocation::vertices)
      select_values(field, vertices);
}

/// The periods; 0 in the direction in which a channel has walls.
Eigen::Vector2d read_periods(const NetcdfReader& file) {
  const Eigen::Vector2d period(file.number("", "x_period", 0), file.number("", "y_period", 0));
  if (!period.allFinite() || period.minCoeff() < 0 || period.maxCoeff() == 0)
    file.fail("neither x_period nor y_period is positive, or one is negative; a plane has a "
              "period in one direction or two, or the attribute is_periodic \"NO\"");
  return period;
}

/// Maps x and y into [0, period). Values in that range keep their bits.
void wrap(Points3& points, const Eigen::Vector2d& period) {
  const Plane plane(period);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    set_column(points, i, plane.wrapped(column(points, i)));
}

bool has_edge_fields(const RawMesh& raw) {
  return std::any_of(raw.fields.begin(), raw.fields.end(),
                     [](const MeshField& field) { return field.location == FieldLocation::edges; });
}

/// Reads the cells of the edges, if there are fields at edges.
void read_edges(const NetcdfReader& file, std::int64_t cells, RawMesh& raw) {
  if (!has_edge_fields(raw) || !file.has_variable(mpas::cells_on_edge))
    return;
  const std::vector<std::int32_t> ids =
      read_ids(file, mpas::cells_on_edge, {file.dimension(mpas_edge.dimension()), 2}, "edge", 2,
               "cell", cells);
  raw.edges = Eigen::Map<const Pairs>(ids.data(), 2, std::ssize(ids) / 2);
}

void read_density_and_fields(const NetcdfReader& file, std::int64_t cells, FieldChoice choice,
                             RawMesh& raw) {
  read_fields(file, mpas_names(), choice, raw);
  read_edges(file, cells, raw);
  if (file.has_variable(mpas::mesh_density) &&
      file.shape_of(mpas::mesh_density) == std::vector<std::int64_t>{cells}) {
    const std::vector<double> density = cf_values(file, mpas::mesh_density, {cells});
    raw.density = Eigen::Map<const DoubleVector>(density.data(), cells);
  }
}

bool has_polygons(const NetcdfReader& file) {
  return file.has_variable(mpas::vertices_on_cell) && file.has_variable(mpas::n_edges_on_cell) &&
         file.has_variable("xVertex");
}

Points3 read_finite_coordinates(const NetcdfReader& file, const MpasKind& kind) {
  Points3 points = read_coordinates(file, kind);
  if (!points.allFinite())
    file.fail("a coordinate {} or {} is NaN or infinite; make the file again", kind.axis(0),
              kind.axis(1));
  points.row(2).setZero();
  return points;
}

/// Requires the vertices without a cell that a channel has along its walls. MPAS-Tools makes a
/// channel from a plane that is periodic in both directions, whose rows of cells at the walls must
/// be removed.
void require_walls(const NetcdfReader& file, const Eigen::Vector2d& period, bool closed) {
  if (closed && period.minCoeff() == 0)
    file.fail("{} is 0, which makes a channel, but cells join its walls; {}",
              period.x() == 0 ? "x_period" : "y_period",
              file.has_variable("cullCell")
                  ? "remove those that cullCell marks, with MpasCellCuller.x"
                  : "give the period, or remove the cells between the walls");
}

/// The cells of a channel, or of a box with land.
Polygons cells_between_walls(const NetcdfReader& file, Points3 cells, const Surface& plane) {
  if (!has_polygons(file))
    file.fail("a periodic plane with a boundary, but no cells (nEdgesOnCell, verticesOnCell and "
              "xVertex); make the file again");
  Points3 vertices = read_finite_coordinates(file, mpas_vertex);
  wrap(vertices, plane.period());
  Polygons polygons = read_polygons(file, std::move(cells), std::move(vertices));
  polygons.surface = plane;
  return polygons;
}

/// Reads a plane with a boundary. Its triangles do not cover the hull, and its vertices do not
/// correspond to triangles.
RawMesh read_bounded_plane(const NetcdfReader& file, FieldChoice choice) {
  if (!has_polygons(file))
    file.fail("a plane without periods, but no cells (nEdgesOnCell, verticesOnCell and xVertex); "
              "make the file again");
  RawMesh raw{
      .points = read_coordinates(file, mpas_cell), .has_cells = true, .surface = Surface::plane()};
  Points3 vertices = read_finite_coordinates(file, mpas_vertex);
  read_density_and_fields(file, raw.points.cols(), choice, raw);
  raw.polygons = read_polygons(file, raw.points, std::move(vertices));
  raw.polygons.surface = raw.surface;
  return raw;
}

RawMesh read_periodic_plane(const NetcdfReader& file, FieldChoice choice) {
  const Eigen::Vector2d period = read_periods(file);
  RawMesh raw{.points = read_finite_coordinates(file, mpas_cell),
              .has_cells = true,
              .surface = domain_detail::UncheckedSurface::of_plane({}, period)};
  wrap(raw.points, period);
  CompleteVertices complete = complete_vertices(file, raw.points.cols());
  read_density_and_fields(file, raw.points.cols(), choice, raw);
  require_walls(file, period, complete.all);
  if (!complete.all) {
    raw.polygons = cells_between_walls(file, raw.points, raw.surface);
    select_vertices(raw.fields, complete.vertex);
  }
  raw.triangles = std::move(complete.triangles);
  return raw;
}

RawMesh read_sphere(const NetcdfReader& file, FieldChoice choice) {
  RawMesh raw{.points = read_mpas_sites(file), .has_cells = true};
  require_directions(file.path(), raw.points);
  const std::int64_t cells = raw.points.cols();
  CompleteVertices complete = complete_vertices(file, cells);
  read_density_and_fields(file, cells, choice, raw);
  if (has_polygons(file)) {
    const Points3 vertices = read_coordinates(file, mpas_vertex);
    require_directions(file.path() + ": of the vertices", vertices);
    raw.corner_rounding = find_rounding(file, mpas_cell.axis(0));
    if (!complete.all ||
        !are_cell_corners(raw.points, complete.triangles, vertices, raw.corner_rounding))
      raw.polygons = read_polygons(file, on_sphere(raw.points, 1), on_sphere(vertices, 1));
  }
  if (!complete.all)
    select_vertices(raw.fields, complete.vertex);
  raw.triangles = std::move(complete.triangles);
  return raw;
}

} // namespace

bool is_mpas(const NetcdfReader& file) {
  return file.has_variable("xCell") && file.has_variable("yCell") && file.has_variable("zCell");
}

bool is_planar_mpas(const NetcdfReader& file) {
  return file.text("", "on_a_sphere").starts_with("NO");
}

Points3 read_mpas_sites(const NetcdfReader& file) {
  require(!is_planar_mpas(file),
          "{} holds a mesh of the plane, not of the sphere; read it with read_mesh()", file.path());
  return read_coordinates(file, mpas_cell);
}

RawMesh read_mpas(const NetcdfReader& file, FieldChoice choice) {
  RawMesh raw = !is_planar_mpas(file) ? read_sphere(file, choice)
                : file.text("", "is_periodic").starts_with("NO")
                    ? read_bounded_plane(file, choice)
                    : read_periodic_plane(file, choice);
  raw.vertex_order = read_vertex_order(file);
  return raw;
}

} // namespace calotte::io_detail
