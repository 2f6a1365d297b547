// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas/mpas_open.h"
#include "base/message.h"
#include "io/mpas/mpas_variables.h"
#include "io/mpas/vertex_order.h"

#include "io/bytes/broken.h"

#include <algorithm>
#include <span>

namespace calotte::io_detail {
namespace {

/// Reads a table of ids below a bound. \returns whether the file has it.
bool read_table(const std::string& name, std::int64_t rows, std::int64_t width, std::int64_t bound,
                IdTable& table, Deviations& deviations) {
  if (!deviations.has(name, {rows, width}))
    return false;
  table.width = deviations.width(name);
  table.ids = deviations.file().ints(name, {rows, width});
  Differences outside;
  for (std::size_t k = 0; k < table.ids.size(); ++k) {
    const std::int32_t id = table.ids[k];
    const bool inside = id >= 0 && id <= bound;
    if (!inside)
      outside.note(static_cast<std::int64_t>(k), id, 0, 1);
    table.ids[k] = inside ? id - 1 : -1;
  }
  deviations.add(name, outside, "ids in range");
  return true;
}

/// Checks a law of the rows of a variable. \returns whether all rows keep it.
template <class VerdictAt>
bool check_law(const std::string& variable, std::int64_t rows, const std::string& problem,
               const VerdictAt& verdict_at, Deviations& deviations) {
  const Broken found = broken(rows, verdict_at);
  if (found.any())
    deviations.add(variable,
                   message("{}: {} {}; the first is {} (0-based)", variable, found.of_all(),
                           problem, found.first),
                   found.first);
  return !found.any();
}

// ---- Edges and vertices

/// Whether b follows a counter-clockwise around a vertex with three cells.
bool follows(const IdTable& cells, std::int64_t vertex, std::int32_t a, std::int32_t b) {
  for (int j = 0; j < 3; ++j)
    if (cells.at(vertex, j) == a)
      return cells.at(vertex, (j + 1) % 3) == b;
  return false;
}

/// Whether a vertex has both cells of an edge; `b` must follow `a`, unless a cell of the vertex is
/// missing.
bool has_cells(const OpenLists& lists, std::int32_t vertex, std::int32_t a, std::int32_t b) {
  const IdTable& cells = lists.cells_on_vertex;
  if (vertex < 0)
    return false;
  if (a < 0 || b < 0)
    return cells.has(vertex, std::max(a, b));
  return cells.has(vertex, -1) ? cells.has(vertex, a) && cells.has(vertex, b)
                               : follows(cells, vertex, a, b);
}

Verdict edge_verdict(const OpenLists& lists, std::int64_t e) {
  const std::int32_t a = lists.cells_on_edge.at(e, 0), b = lists.cells_on_edge.at(e, 1);
  const std::int32_t right = lists.vertices_on_edge.at(e, 0),
                     left = lists.vertices_on_edge.at(e, 1);
  return verdict_of(right != left && has_cells(lists, right, b, a) && has_cells(lists, left, a, b));
}

/// Checks the edges at a vertex: they end there, and those of a complete vertex enclose its cells.
Verdict vertex_verdict(const OpenLists& lists, std::int64_t v) {
  const bool complete = !lists.cells_on_vertex.has(v, -1);
  for (int j = 0; j < 3; ++j) {
    const std::int32_t e = lists.edges_on_vertex.at(v, j),
                       next = lists.edges_on_vertex.at(v, (j + 1) % 3),
                       cell = lists.cells_on_vertex.at(v, j);
    if (e < 0 && complete)
      return Verdict::breaks;
    if (e >= 0 && !lists.vertices_on_edge.has(e, static_cast<std::int32_t>(v)))
      return Verdict::breaks;
    if (complete &&
        (next < 0 || !lists.cells_on_edge.has(e, cell) || !lists.cells_on_edge.has(next, cell)))
      return Verdict::breaks;
  }
  return Verdict::keeps;
}

bool check_edges(const OpenLists& lists, Deviations& deviations) {
  const std::int64_t edges = lists.cells_on_edge.rows();
  const bool pairs = check_law(
      mpas::cells_on_edge, edges, "edges have no cell, or one cell twice",
      [&](std::int64_t e) {
        return verdict_of(lists.cells_on_edge.at(e, 0) != lists.cells_on_edge.at(e, 1));
      },
      deviations);
  return check_law(
             mpas::vertices_on_edge, edges,
             "edges do not run, with their first cell to the left, between two vertices of both "
             "cells",
             [&](std::int64_t e) { return edge_verdict(lists, e); }, deviations) &&
         pairs;
}

// ---- Cells

/// Counts the edges that name each cell.
std::vector<std::int32_t> edges_by_cell(const OpenLists& lists) {
  std::vector<std::int32_t> count(static_cast<std::size_t>(lists.cells));
  for (const std::int32_t cell : lists.cells_on_edge.ids)
    if (cell >= 0)
      ++count[static_cast<std::size_t>(cell)];
  return count;
}

std::int32_t other_cell(const OpenLists& lists, std::int32_t e, std::int64_t cell) {
  return lists.cells_on_edge.at(e, lists.cells_on_edge.at(e, 0) == cell ? 1 : 0);
}

Verdict padded(const IdTable& table, std::int64_t row, std::int64_t count) {
  for (std::int64_t k = count; k < table.width; ++k)
    if (table.at(row, k) >= 0)
      return Verdict::breaks;
  return Verdict::keeps;
}

/// Checks holds(k, edge) for each edge of a cell, and the padding after the last one.
template <class Holds>
Verdict cell_verdict(const OpenLists& lists, const IdTable& table, std::int64_t i,
                     const Holds& holds) {
  const std::int64_t count = lists.edge_count[static_cast<std::size_t>(i)];
  if (count > lists.edges_on_cell.width || count > table.width)
    return Verdict::breaks;
  for (std::int64_t k = 0; k < count; ++k)
    if (const std::int32_t e = lists.edges_on_cell.at(i, k); e < 0 || !holds(k, e))
      return Verdict::breaks;
  return padded(table, i, count);
}

Verdict edges_verdict(const OpenLists& lists, std::int64_t i) {
  return cell_verdict(lists, lists.edges_on_cell, i, [&](std::int64_t k, std::int32_t e) {
    bool once = true;
    for (std::int64_t other = 0; other < k; ++other)
      once = once && lists.edges_on_cell.at(i, other) != e;
    return once && lists.cells_on_edge.has(e, static_cast<std::int32_t>(i));
  });
}

/// Checks vertices: seen from its first cell, edge k leads from vertex k - 1 to vertex k.
Verdict corners_verdict(const OpenLists& lists, std::int64_t i) {
  const std::int64_t count = lists.edge_count[static_cast<std::size_t>(i)];
  return cell_verdict(lists, lists.vertices_on_cell, i, [&](std::int64_t k, std::int32_t e) {
    const bool first = lists.cells_on_edge.at(e, 0) == i;
    return lists.vertices_on_cell.at(i, (k + count - 1) % count) ==
               lists.vertices_on_edge.at(e, first ? 0 : 1) &&
           lists.vertices_on_cell.at(i, k) == lists.vertices_on_edge.at(e, first ? 1 : 0);
  });
}

Verdict neighbours_verdict(const OpenLists& lists, std::int64_t i) {
  return cell_verdict(lists, lists.cells_on_cell, i, [&](std::int64_t k, std::int32_t e) {
    return lists.cells_on_cell.at(i, k) == other_cell(lists, e, i);
  });
}

bool check_cells(const OpenLists& lists, Deviations& deviations) {
  const std::vector<std::int32_t> count = edges_by_cell(lists);
  const auto law = [&](const std::string& variable, const std::string& problem,
                       const auto& verdict_at) {
    return check_law(variable, lists.cells, problem, verdict_at, deviations);
  };
  const bool counts = law(mpas::n_edges_on_cell,
                          "cells have another number of edges in cellsOnEdge", [&](std::int64_t i) {
                            const auto cell = static_cast<std::size_t>(i);
                            return verdict_of(count[cell] == lists.edge_count[cell]);
                          });
  return counts &&
         law(mpas::edges_on_cell, "cells do not list their edges, each once, then 0",
             [&](std::int64_t i) { return edges_verdict(lists, i); }) &&
         law(mpas::vertices_on_cell,
             "cells do not list the ends of their edges, counter-clockwise, then 0",
             [&](std::int64_t i) { return corners_verdict(lists, i); }) &&
         law(mpas::cells_on_cell, "cells do not list the cells across their edges, then 0",
             [&](std::int64_t i) { return neighbours_verdict(lists, i); });
}

/// \pre they are before the edges.
void put_vertices_after_edges(OpenLists& lists) {
  IdTable& table = lists.vertices_on_cell;
  for (std::int64_t i = 0; i < table.rows(); ++i)
    if (const auto count = lists.edge_count[static_cast<std::size_t>(i)];
        count >= 0 && count <= table.width)
      put_after_edges(std::span(table.ids).subspan(static_cast<std::size_t>(i * table.width),
                                                   static_cast<std::size_t>(count)));
}

} // namespace

bool read_open_lists(std::int64_t cells, OpenLists& lists, Deviations& deviations) {
  const NetcdfReader& file = deviations.file();
  const std::int64_t vertices = file.dimension(mpas_vertex.dimension()),
                     edges = file.dimension(mpas_edge.dimension());
  const auto read = [&](const std::string& name, std::int64_t rows, std::int64_t width,
                        std::int64_t bound, IdTable& table) {
    return rows >= 0 && read_table(name, rows, width, bound, table, deviations);
  };
  lists.cells = cells;
  if (!read(mpas::cells_on_vertex, vertices, 3, cells, lists.cells_on_vertex) ||
      !read(mpas::edges_on_vertex, vertices, 3, edges, lists.edges_on_vertex) ||
      !read(mpas::cells_on_edge, edges, 2, cells, lists.cells_on_edge) ||
      !read(mpas::vertices_on_edge, edges, 2, vertices, lists.vertices_on_edge) ||
      !read(mpas::edges_on_cell, cells, -1, edges, lists.edges_on_cell) ||
      !read(mpas::vertices_on_cell, cells, -1, vertices, lists.vertices_on_cell) ||
      !read(mpas::cells_on_cell, cells, -1, cells, lists.cells_on_cell) ||
      !deviations.has(mpas::n_edges_on_cell, {cells}))
    return false;
  lists.edge_count = file.ints(mpas::n_edges_on_cell, {cells});
  if (read_vertex_order(file) == VertexOrder::before_edges)
    put_vertices_after_edges(lists);
  return true;
}

bool check_open_lists(const OpenLists& lists, Deviations& deviations) {
  const bool edges = check_edges(lists, deviations);
  const bool vertices = check_law(
      mpas::edges_on_vertex, lists.cells_on_vertex.rows(),
      "vertices do not list edges that end there, edge j before cell j of cellsOnVertex",
      [&](std::int64_t v) { return vertex_verdict(lists, v); }, deviations);
  return check_cells(lists, deviations) && edges && vertices;
}

} // namespace calotte::io_detail
