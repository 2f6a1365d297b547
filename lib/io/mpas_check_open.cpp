// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas_check.h"

#include "base/matrix_memory.h"
#include "base/points.h"
#include "exact/predicates.h"
#include "io/mpas_open.h"
#include "io/polygons.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

// The part of a tessellation that an open mesh has, in the numbering of its file. Places of
// vertices that lack a cell are the file's; all else follows from these and from the cells.

namespace calotte::io_detail {
namespace {

/// Stands for the missing cell of an edge: no cell is higher, so that the edge's normal leaves the
/// one that is there.
constexpr std::int32_t no_cell = std::numeric_limits<std::int32_t>::max();

double arc(const Vec3& a, const Vec3& b) { return 2 * std::atan2(norm(b - a), norm(a + b)); }

/// As polygons have it.
double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2 * std::atan2(dot(a, cross(b - a, c - a)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

// ---- Ids

void set_edges(const OpenLists& lists, Voronoi& out, MpasNumbering& numbering) {
  const std::int64_t edges = lists.cells_on_edge.rows();
  out.cells_on_edge.resize(2, edges);
  out.vertices_on_edge.resize(2, edges);
  numbering.edge = Array<std::int32_t>(edges);
  numbering.file_edge = Array<std::int32_t>(edges);
  numbering.reversed = Array<std::uint8_t>(edges);
  for (std::int32_t e = 0; e < edges; ++e) {
    const std::int32_t first = lists.cells_on_edge.at(e, 0);
    const std::int32_t second =
        lists.cells_on_edge.at(e, 1) < 0 ? no_cell : lists.cells_on_edge.at(e, 1);
    const bool reversed = second < first;
    for (int k = 0; k < 2; ++k) {
      out.cells_on_edge(reversed ? 1 - k : k, e) = k == 0 ? first : second;
      out.vertices_on_edge(reversed ? 1 - k : k, e) = lists.vertices_on_edge.at(e, k);
    }
    numbering.edge[e] = numbering.file_edge[e] = e;
    numbering.reversed[e] = reversed;
  }
}

void set_vertices(const OpenLists& lists, Voronoi& out, MpasNumbering& numbering) {
  const std::int64_t vertices = lists.cells_on_vertex.rows();
  out.cells_on_vertex = Eigen::Map<const Triangles>(lists.cells_on_vertex.ids.data(), 3, vertices);
  out.edges_on_vertex = Eigen::Map<const Triangles>(lists.edges_on_vertex.ids.data(), 3, vertices);
  numbering.vertex = Array<std::int32_t>(vertices);
  numbering.vertex_start = Array<std::int8_t>(vertices);
  numbering.file_vertex = Array<std::int32_t>(vertices);
  for (std::int32_t v = 0; v < vertices; ++v) {
    numbering.vertex[v] = v;
    numbering.vertex_start[v] = 0;
    numbering.file_vertex[v] = v;
  }
}

void set_cells(const OpenLists& lists, Voronoi& out) {
  out.begin.resize(lists.cells + 1);
  out.begin[0] = 0;
  for (std::int64_t i = 0; i < lists.cells; ++i)
    out.begin[i + 1] = out.begin[i] + lists.edge_count[static_cast<std::size_t>(i)];
  for (Ids* ids : {&out.edges_on_cell, &out.vertices_on_cell, &out.cells_on_cell})
    ids->resize(out.begin[lists.cells]);
  for (std::int64_t i = 0; i < lists.cells; ++i)
    for (std::int64_t k = 0; k < out.begin[i + 1] - out.begin[i]; ++k) {
      const std::int32_t other = lists.cells_on_cell.at(i, k);
      out.edges_on_cell[out.begin[i] + k] = lists.edges_on_cell.at(i, k);
      out.vertices_on_cell[out.begin[i] + k] = lists.vertices_on_cell.at(i, k);
      out.cells_on_cell[out.begin[i] + k] = other < 0 ? no_cell : other;
    }
}

// ---- Places and measures

/// The vertices as the file has them, or none.
Points3 stored_vertices(Deviations& deviations) {
  const std::int64_t vertices = deviations.file().dimension("nVertices");
  Points3 places(3, std::max<std::int64_t>(vertices, 0));
  for (int row = 0; row < 3; ++row) {
    const std::string name = std::string(1, "xyz"[row]) + "Vertex";
    if (!deviations.has(name, {vertices}))
      return {};
    const std::vector<double> values = deviations.file().doubles(name, {vertices});
    places.row(row) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), vertices);
  }
  return places.colwise().normalized();
}

void place_vertices(Points3 stored, Voronoi& out) {
  out.vertices = std::move(stored);
  for (Eigen::Index v = 0; v < out.cells_on_vertex.cols(); ++v) {
    if (out.cells_on_vertex.col(v).minCoeff() < 0)
      continue;
    const Vec3& a = column(out.cells, out.cells_on_vertex(0, v));
    const Vec3 normal = cross(column(out.cells, out.cells_on_vertex(1, v)) - a,
                              column(out.cells, out.cells_on_vertex(2, v)) - a);
    set_column(out.vertices, v, (1 / norm(normal)) * normal);
  }
}

/// The angle from east of a direction at a place.
double angle_from_east(const Vec3& place, const Vec3& direction) {
  const Vec3 east{-place.y, place.x, 0};
  return std::atan2(dot(direction, cross(place, east)), dot(direction, east));
}

void measure_edges(Voronoi& out) {
  const std::int64_t edges = out.cells_on_edge.cols();
  make_room(out.edges, 3, edges);
  for (Eigen::VectorXd* values : {&out.dc, &out.dv, &out.angle})
    make_room(*values, edges, 1);
  for_each_block(edges, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e != end; ++e) {
      const bool inner = out.cells_on_edge(1, e) != no_cell;
      const Vec3 &right = column(out.vertices, out.vertices_on_edge(0, e)),
                 &left = column(out.vertices, out.vertices_on_edge(1, e));
      const Vec3& from = column(out.cells, out.cells_on_edge(0, e));
      const Vec3& to = inner ? column(out.cells, out.cells_on_edge(1, e)) : from;
      const Vec3 middle = normalised(inner ? from + to : right + left);
      set_column(out.edges, e, middle);
      out.dv[e] = arc(right, left);
      out.dc[e] = inner ? arc(from, to) : std::numbers::sqrt3 * out.dv[e];
      out.angle[e] = angle_from_east(middle, inner ? to - from : cross(left - right, middle));
    }
  });
}

/// The kites of cells that are there, between edges that are.
void measure_kites(Voronoi& out) {
  const std::int64_t vertices = out.cells_on_vertex.cols();
  out.kites.setZero(3, vertices);
  for_each_block(vertices, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v != end; ++v)
      for (int j = 0; j < 3; ++j) {
        const std::int32_t cell = out.cells_on_vertex(j, v), e = out.edges_on_vertex(j, v);
        std::int32_t next = out.edges_on_vertex((j + 1) % 3, v);
        if (next < 0) // a list of two edges
          next = out.edges_on_vertex((j + 2) % 3, v);
        if (cell < 0 || e < 0 || next < 0)
          continue;
        const Vec3 &p = column(out.vertices, v), &c = column(out.cells, cell);
        out.kites(j, v) = triangle_area(p, column(out.edges, e), c) +
                          triangle_area(p, c, column(out.edges, next));
      }
  });
  out.vertex_area = out.kites.colwise().sum().transpose();
}

/// As polygons of their vertices; what a file has for an incomplete cell is -1, whatever its unit.
void measure_cells(double radius, Voronoi& out) {
  const Polygons cells{out.vertices, out.begin, out.vertices_on_cell, {}};
  out.cell_area = areas_of(cells);
  for (double& area : out.cell_area)
    if (!(area > 0))
      area = -1 / (radius * radius);
}

} // namespace

void check_open_mpas(const MeshFile& file, double radius, Deviations& deviations) {
  Voronoi part;
  MpasNumbering numbering;
  OpenLists lists;
  part.cells = file.mesh->points.colwise().normalized();
  Points3 vertices = stored_vertices(deviations);
  const bool whole = read_open_lists(part.cells.cols(), lists, deviations) && vertices.cols() > 0 &&
                     lists.cells_on_edge.rows() > 0;
  if (whole && !check_open_lists(lists, deviations))
    return;
  if (whole) {
    set_edges(lists, part, numbering);
    set_vertices(lists, part, numbering);
    set_cells(lists, part);
    place_vertices(std::move(vertices), part);
    measure_edges(part);
    measure_kites(part);
    measure_cells(radius, part);
  }
  const double width = whole ? part.dc.mean() : 1;
  CellFields fields;
  if (whole)
    fields = cell_fields(part);
  if (whole && file.density.size() == part.cells.cols())
    fields.density = file.density;
  const MpasCheck check{deviations,         part, fields, numbering, radius, width,
                        rounding_of_others, false};
  check_mpas_places(check);
  if (!whole)
    return;
  check_mpas_measures(check);
  check_mpas_weights(check);
  check_mpas_quality(check);
}

} // namespace calotte::io_detail
