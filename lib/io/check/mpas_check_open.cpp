// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "base/message.h"
#include "base/points.h"
#include "domain/clipped_cell.h"
#include "exact/space.h"
#include "io/cells/limited_area_masks.h"
#include "io/cells/open_cells.h"
#include "io/mpas/mpas.h"
#include "io/mpas/mpas_open.h"
#include "voronoi/open.h"

#include <calotte/limited_area.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

// The part of a tessellation that an open mesh has, with the numbers of its file. Positions of
// vertices that lack a cell come from the file. Everything else follows from these and from the
// cells.

namespace calotte::io_detail {
namespace {

// ---- Ids

/// Sets the edges. If an edge has a single cell, it becomes the first one.
/// \returns by edge, whether the single cell is the second one in the file.
Array<std::uint8_t> set_edges(const OpenLists& lists, Voronoi& out) {
  const std::int64_t edges = lists.cells_on_edge.rows();
  out.cells_on_edge = Eigen::Map<const Pairs>(lists.cells_on_edge.ids.data(), 2, edges);
  out.vertices_on_edge = Eigen::Map<const Pairs>(lists.vertices_on_edge.ids.data(), 2, edges);
  Array<std::uint8_t> flipped(edges);
  for (std::int64_t e = 0; e < edges; ++e) {
    flipped[e] = out.cells_on_edge(0, e) < 0;
    if (flipped[e] == 0)
      continue;
    std::swap(out.cells_on_edge(0, e), out.cells_on_edge(1, e));
    std::swap(out.vertices_on_edge(0, e), out.vertices_on_edge(1, e));
  }
  return flipped;
}

void set_vertices(const OpenLists& lists, Voronoi& out) {
  const std::int64_t vertices = lists.cells_on_vertex.rows();
  out.cells_on_vertex = Eigen::Map<const Triangles>(lists.cells_on_vertex.ids.data(), 3, vertices);
  out.edges_on_vertex = Eigen::Map<const Triangles>(lists.edges_on_vertex.ids.data(), 3, vertices);
}

/// The rows of a table without their padding.
IdLists without_padding(const IdTable& table, const Offsets& begin) {
  IdLists lists{begin, Ids(begin[begin.size() - 1])};
  for (std::int64_t i = 0; i < lists.size(); ++i)
    for (std::int64_t k = 0; k < lists.count(i); ++k)
      lists.items[begin[i] + k] = table.at(i, k);
  return lists;
}

void set_cells(const OpenLists& lists, Voronoi& out) {
  Offsets begin(lists.cells + 1);
  begin[0] = 0;
  for (std::int64_t i = 0; i < lists.cells; ++i)
    begin[i + 1] = begin[i] + lists.edge_count[static_cast<std::size_t>(i)];
  out.edges_on_cell = without_padding(lists.edges_on_cell, begin);
  out.vertices_on_cell = without_padding(lists.vertices_on_cell, begin);
  out.cells_on_cell = without_padding(lists.cells_on_cell, begin);
}

// ---- Positions and measures

/// Reads the coordinates of vertices or edges; none if the file has none.
Points3 read_coordinates(const MpasKind& kind, std::int64_t count, bool on_sphere,
                         Deviations& deviations) {
  Points3 points(3, std::max<std::int64_t>(count, 0));
  for (int row = 0; row < 3; ++row) {
    const std::string name = kind.axis(row);
    if (!deviations.has(name, {count}))
      return {};
    const std::vector<double> values = deviations.file().doubles(name, {count});
    points.row(row) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), count);
  }
  if (on_sphere)
    for (auto point : points.colwise())
      point /= point.norm();
  return points;
}

void set_vertex_positions(Points3 stored, Voronoi& out) {
  out.vertices = std::move(stored);
  for (Eigen::Index v = 0; v < out.cells_on_vertex.cols(); ++v) {
    if (out.cells_on_vertex.col(v).minCoeff() < 0)
      continue;
    set_column(out.vertices, v, cell_circumcentre(out, v));
  }
}

/// If a file was cut from another, edges towards missing cells kept their positions and lengths.
/// Programs that compute the edges use the midpoint of the vertices.
/// \returns the positions of edges that were kept; NaN for others.
Points3 cut_edges(const Voronoi& part, double radius, Deviations& deviations) {
  constexpr double halves_agree = 1e-5; // tolerance for half the distance to the missing cell
  const std::int64_t edges = part.cells_on_edge.cols();
  Points3 points = read_coordinates(mpas_edge, edges, part.surface.is_sphere(), deviations);
  if (points.cols() == 0 || !deviations.has(mpas::dc_edge, {edges}))
    return {};
  const std::vector<double> lengths = deviations.file().doubles(mpas::dc_edge, {edges});
  for (std::int64_t e = 0; e < edges; ++e) {
    const Vec3 &edge = column(points, e), &cell = column(part.cells, part.cells_on_edge(0, e));
    const double dc = lengths[static_cast<std::size_t>(e)] / radius,
                 way = part.surface.is_sphere()
                           ? 2 * std::asin(std::min(norm(edge - cell) / 2, 1.0))
                           : norm(Plane(part.surface.period()).offset(cell, edge));
    if (part.cells_on_edge(1, e) >= 0 || !(std::abs(dc - 2 * way) < halves_agree * dc))
      points.col(e).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return points;
}

/// Sets the area of incomplete cells to -1 in the unit of the file.
void mark_incomplete_cells(double radius, Voronoi& out) {
  for (double& area : out.cell_area)
    if (!(area > 0))
      area = -1 / (radius * radius);
}

/// The points of the mesh; on the sphere, as unit vectors.
Points3 unit_points(const MeshFile& file) {
  Points3 cells = file.mesh->points;
  if (file.sphere())
    for (auto unit : cells.colwise())
      unit /= unit.norm();
  return cells;
}

// ---- Masks of a limited area

/// Checks the masks of edges and vertices, which follow from that of the cells.
void check_masks(const Voronoi& part, Deviations& deviations) {
  const NetcdfReader& file = deviations.file();
  const std::vector<std::int64_t> by_cell{part.cells.cols()};
  if (!file.has_variable(cell_mask) || !file.is_integer(cell_mask) ||
      file.shape_of(cell_mask) != by_cell)
    return;
  const std::vector<std::int32_t> stored = file.ints(cell_mask, by_cell);
  const Ids of_cells = Eigen::Map<const Ids>(stored.data(), std::ssize(stored));
  const auto check = [&](const DerivedMask& mask, const IdLists& on_cell, std::int64_t count) {
    if (!file.has_variable(mask.name))
      return deviations.add(
          mask.name,
          message("{}: is missing, and MPAS reads it where there is {}", mask.name, cell_mask));
    if (!deviations.has(mask.name, {count}))
      return;
    const Ids least = least_mask(on_cell, of_cells, count);
    deviations.check_rows<std::int32_t>(
        mask.name, message("the {}", mask.meaning),
        [&](std::int64_t row, const std::int32_t* value, Differences& out) {
          out.compare(row, *value, least[row]);
        });
  };
  check(edge_mask, part.edges_on_cell, part.cells_on_edge.cols());
  check(vertex_mask, part.vertices_on_cell, part.cells_on_vertex.cols());
}

} // namespace

void check_open_mpas(const MeshFile& file, double radius, Deviations& deviations) {
  Voronoi part;
  OpenLists lists;
  part.surface = file.mesh->surface;
  part.cells = unit_points(file);
  MpasCheck check{.deviations = deviations, .voronoi = part, .radius = radius, .closed = false};
  Points3 vertices =
      read_coordinates(mpas_vertex, deviations.file().dimension(mpas_vertex.dimension()),
                       part.surface.is_sphere(), deviations);
  const bool whole = read_open_lists(part.cells.cols(), lists, deviations) && vertices.cols() > 0 &&
                     lists.cells_on_edge.rows() > 0;
  if (!whole)
    return compare_mpas(check);
  if (!check_open_lists(lists, deviations))
    return;
  check.flipped = set_edges(lists, part);
  set_vertices(lists, part);
  set_cells(lists, part);
  set_vertex_positions(std::move(vertices), part);
  voronoi_detail::measure_open(part, cut_edges(part, radius, deviations));
  mark_incomplete_cells(radius, part);
  check_masks(part, deviations);
  check.set_width(part.dc.mean());
  if (file.density.size() == part.cells.cols())
    check.density = file.density;
  compare_mpas(check);
  check_mpas_density(check);
}

} // namespace calotte::io_detail
