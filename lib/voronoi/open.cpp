// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/open.h"

#include "base/lists.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/spherical_angles.h"
#include "exact/space.h"
#include "voronoi/connectivity.h"
#include "voronoi/groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>
#include <vector>

namespace calotte::voronoi_detail {
namespace {

// ---- Edges

/// A side of a cell, between two vertices: index k of the cell's lists runs from vertex k - 1 to k.
struct CellSide {
  std::int32_t low, high; ///< the vertices by number
  std::int32_t cell;
  std::size_t index;
};

/// The sides of cells, sorted by their vertices, then by cell.
std::vector<CellSide> list_sides(const Voronoi& of) {
  std::vector<CellSide> sides;
  sides.reserve(static_cast<std::size_t>(of.vertices_on_cell.items.size()));
  for (std::int32_t i = 0; i < of.cells.cols(); ++i)
    for (std::size_t index = 0; index != of.vertices_on_cell[i].size(); ++index) {
      const auto [low, high] = std::minmax({start_of(of, i, index), of.vertices_on_cell[i][index]});
      sides.push_back({low, high, i, index});
    }
  sort_in_groups(
      of.vertices.cols(), [](const CellSide& side) { return side.low; },
      [](const CellSide& a, const CellSide& b) {
        return std::tie(a.high, a.cell, a.index) < std::tie(b.high, b.cell, b.index);
      },
      sides);
  return sides;
}

/// An edge, with its index in the lists of its cells.
struct Edge {
  std::array<std::int32_t, 2> cell{none, none};
  std::array<std::size_t, 2> index{};

  bool inner() const { return cell[1] >= 0; }
};

/// Whether two sides form an edge: they run in opposite directions.
bool fit(const Voronoi& of, const CellSide& a, const CellSide& b) {
  return a.cell != b.cell && start_of(of, a.cell, a.index) == of.vertices_on_cell[b.cell][b.index];
}

std::vector<Edge> join_sides(const Voronoi& of) {
  const std::vector<CellSide> sides = list_sides(of);
  const auto same = [&](std::size_t k) {
    return k + 1 < sides.size() && sides[k].low == sides[k + 1].low &&
           sides[k].high == sides[k + 1].high;
  };
  std::vector<Edge> edges;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const CellSide& side = sides[k];
    Edge edge{{side.cell, none}, {side.index, 0}};
    if (same(k)) {
      const CellSide& other = sides[++k];
      if (same(k) || !fit(of, side, other))
        refuse_at(side.cell,
                  "cell {} and cell {} overlap, as they do not lie on opposite sides of their "
                  "common edge",
                  other.cell);
      edge.cell[1] = other.cell;
      edge.index[1] = other.index;
    }
    edges.push_back(edge);
  }
  const std::int64_t cells = of.cells.cols();
  sort_in_groups(
      2 * cells, [&](const Edge& edge) { return edge.cell[0] + (edge.inner() ? 0 : cells); },
      [](const Edge& a, const Edge& b) {
        return std::tie(a.cell, a.index) < std::tie(b.cell, b.index);
      },
      edges);
  return edges;
}

void set_edges(const std::vector<Edge>& edges, Voronoi& out) {
  const auto count = std::ssize(edges);
  out.cells_on_edge.resize(2, count);
  out.vertices_on_edge.resize(2, count);
  out.edges_on_cell.begin = out.cells_on_cell.begin = out.vertices_on_cell.begin;
  out.edges_on_cell.items.resize(out.vertices_on_cell.items.size());
  out.cells_on_cell.items.resize(out.vertices_on_cell.items.size());
  for (std::int32_t e = 0; e < count; ++e) {
    const Edge& edge = edges[static_cast<std::size_t>(e)];
    out.cells_on_edge.col(e) << edge.cell[0], edge.cell[1];
    out.vertices_on_edge.col(e) << start_of(out, edge.cell[0], edge.index[0]),
        out.vertices_on_cell[edge.cell[0]][edge.index[0]];
    for (std::size_t k = 0; k < 2; ++k)
      if (edge.cell[k] >= 0) {
        out.edges_on_cell[edge.cell[k]][edge.index[k]] = e;
        out.cells_on_cell[edge.cell[k]][edge.index[k]] = edge.cell[1 - k];
      }
  }
}

// ---- Vertices

/// A cell at a vertex, between the edge that leaves the vertex and the one that arrives there,
/// counter-clockwise around the vertex.
struct Sector {
  std::int32_t cell = none, from = none, to = none;
};

struct VertexSectors {
  std::array<Sector, 3> sectors;
  int count = 0;
};

std::vector<VertexSectors> sectors_at_vertices(const Voronoi& of) {
  std::vector<VertexSectors> at_vertices(static_cast<std::size_t>(of.vertices.cols()));
  for (std::int32_t i = 0; i < of.cells.cols(); ++i) {
    const std::span<const std::int32_t> vertices = of.vertices_on_cell[i],
                                        edges = of.edges_on_cell[i];
    for (std::size_t index = 0; index != vertices.size(); ++index) {
      const std::int32_t v = vertices[index];
      VertexSectors& around = at_vertices[static_cast<std::size_t>(v)];
      if (around.count == 3)
        refuse_at(v, "vertex {} is on more than three cells");
      around.sectors[static_cast<std::size_t>(around.count++)] = {
          i, edges[index + 1 == edges.size() ? 0 : index + 1], edges[index]};
    }
  }
  return at_vertices;
}

/// The index of the sector that follows an edge counter-clockwise; 3 for none.
int sector_from(const VertexSectors& around, std::int32_t edge) {
  for (int k = 0; k < around.count; ++k)
    if (around.sectors[static_cast<std::size_t>(k)].from == edge)
      return k;
  return 3;
}

/// The sector that follows the open part around the vertex. Around a vertex without an open part,
/// it is the first sector, that of the lowest cell.
int first_sector(const Voronoi& of, const VertexSectors& around) {
  for (int k = 0; k < around.count; ++k)
    if (of.cells_on_edge(1, around.sectors[static_cast<std::size_t>(k)].from) < 0)
      return k;
  return 0;
}

void set_vertex(std::int32_t v, const VertexSectors& around, Voronoi& out) {
  out.cells_on_vertex.col(v).setConstant(none);
  out.edges_on_vertex.col(v).setConstant(none);
  const int first = first_sector(out, around);
  const bool complete =
      out.cells_on_edge(1, around.sectors[static_cast<std::size_t>(first)].from) >= 0;
  for (int j = 0, k = first; j < around.count; ++j) {
    if (k == 3 || (j > 0 && k == first) || (j == 2 && !complete))
      refuse_at(v, "vertex {} has more than three edges");
    const Sector& sector = around.sectors[static_cast<std::size_t>(k)];
    out.cells_on_vertex(j, v) = sector.cell;
    out.edges_on_vertex(j, v) = sector.from;
    if (j < 2)
      out.edges_on_vertex(j + 1, v) = sector.to;
    k = sector_from(around, sector.to);
  }
  if (complete != (around.count == 3))
    refuse_at(v, "vertex {} is on two cells only, but not on the boundary");
}

// ---- Measures

Vec3 middle(const Sphere&, const Vec3& a, const Vec3& b) { return normalised(a + b); }
Vec3 middle(const Plane& plane, const Vec3& a, const Vec3& b) {
  return plane.wrapped(a + 0.5 * plane.offset(a, b));
}

double length(const Sphere&, const Vec3& a, const Vec3& b) {
  return 2 * std::atan2(norm(b - a), norm(a + b));
}
double length(const Plane& plane, const Vec3& a, const Vec3& b) { return norm(plane.offset(a, b)); }

Vec3 to_the_right(const Sphere&, const Vec3& way, const Vec3& at) { return cross(way, at); }
Vec3 to_the_right(const Plane&, const Vec3& way, const Vec3&) { return {way.y, -way.x, 0}; }

/// The angle of a direction at a point, from east.
double angle(const Sphere&, const Vec3& at, const Vec3& direction) {
  const Vec3 east{-at.y, at.x, 0};
  return std::atan2(dot(direction, cross(at, east)), dot(direction, east));
}
double angle(const Plane&, const Vec3&, const Vec3& direction) {
  return eastern(std::atan2(direction.y, direction.x), 2 * std::numbers::pi);
}

/// The midpoint, length and angle of an edge.
struct EdgeMeasure {
  Vec3 middle;
  double dc;
  Vec3 normal;
};

/// \param cut the midpoint of an edge half way to a missing cell; null for other edges.
template <Space S>
EdgeMeasure measured(const S& space, std::int64_t e, const Vec3* cut, const Voronoi& of) {
  const Vec3& from = column(of.cells, of.cells_on_edge(0, e));
  if (cut != nullptr)
    return {*cut, 2 * length(space, from, *cut), space.offset(from, *cut)};
  if (of.cells_on_edge(1, e) >= 0) {
    const Vec3& to = column(of.cells, of.cells_on_edge(1, e));
    return {middle(space, from, to), length(space, from, to), space.offset(from, to)};
  }
  const Vec3 &right = column(of.vertices, of.vertices_on_edge(0, e)),
             &left = column(of.vertices, of.vertices_on_edge(1, e));
  const Vec3 at = middle(space, right, left);
  return {at, std::numbers::sqrt3 * length(space, right, left),
          to_the_right(space, space.offset(right, left), at)};
}

template <Space S>
void measure_edge(const S& space, std::int64_t e, const Points3& cut_edges, Voronoi& out) {
  const bool cut =
      out.cells_on_edge(1, e) < 0 && cut_edges.cols() > 0 && cut_edges.col(e).allFinite();
  const EdgeMeasure edge = measured(space, e, cut ? &column(cut_edges, e) : nullptr, out);
  set_column(out.edges, e, edge.middle);
  out.dv[e] = length(space, column(out.vertices, out.vertices_on_edge(0, e)),
                     column(out.vertices, out.vertices_on_edge(1, e)));
  out.dc[e] = edge.dc;
  out.angle[e] = angle(space, edge.middle, edge.normal);
}

/// Measures the kites at a vertex of existing cells between existing edges.
template <Space S> void measure_kites(const S& space, std::int64_t v, Voronoi& out) {
  out.vertex_area[v] = 0;
  for (int j = 0; j < 3; ++j) {
    out.kites(j, v) = 0;
    const std::int32_t cell = out.cells_on_vertex(j, v), e = out.edges_on_vertex(j, v);
    std::int32_t next = out.edges_on_vertex((j + 1) % 3, v);
    if (next < 0) // a list of two edges
      next = out.edges_on_vertex((j + 2) % 3, v);
    if (cell < 0 || e < 0 || next < 0)
      continue;
    const Vec3 &p = column(out.vertices, v), &c = column(out.cells, cell);
    out.kites(j, v) =
        space.area(p, column(out.edges, e), c) + space.area(p, c, column(out.edges, next));
    out.vertex_area[v] += out.kites(j, v);
  }
}

/// Measures a cell as a fan of triangles from its site.
template <Space S> void measure_cell(const S& space, std::int32_t i, Voronoi& out) {
  double sum = 0;
  const std::span<const std::int32_t> vertices = out.vertices_on_cell[i];
  for (std::size_t index = 0; index != vertices.size(); ++index)
    sum += space.area(column(out.cells, i), column(out.vertices, start_of(out, i, index)),
                      column(out.vertices, vertices[index]));
  out.cell_area[i] = sum;
}

template <Space S> void measure_part(const S& space, const Points3& cut_edges, Voronoi& out) {
  for_each_block(out.cells_on_edge.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e != end; ++e)
      measure_edge(space, e, cut_edges, out);
  });
  for_each_block(out.cells_on_vertex.cols(),
                 [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                   for (std::int64_t v = begin; v != end; ++v)
                     measure_kites(space, v, out);
                 });
  for_each_block(out.cells.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      measure_cell(space, static_cast<std::int32_t>(i), out);
  });
}

} // namespace

void connect_open(Voronoi& out) {
  set_edges(join_sides(out), out);
  out.cells_on_vertex.resize(3, out.vertices.cols());
  out.edges_on_vertex.resize(3, out.vertices.cols());
  const std::vector<VertexSectors> at_vertices = sectors_at_vertices(out);
  for (std::int32_t v = 0; v < out.vertices.cols(); ++v)
    set_vertex(v, at_vertices[static_cast<std::size_t>(v)], out);
}

void measure_open(Voronoi& out, const Points3& cut_edges) {
  const std::int64_t edges = out.cells_on_edge.cols(), vertices = out.cells_on_vertex.cols();
  out.edges.resize(3, edges);
  for (DoubleVector* values : {&out.dc, &out.dv, &out.angle})
    values->resize(edges);
  out.kites.resize(3, vertices);
  out.vertex_area.resize(vertices);
  out.cell_area.resize(out.cells.cols());
  in_space_of(out.surface, [&](const auto& space) { measure_part(space, cut_edges, out); });
}

} // namespace calotte::voronoi_detail
