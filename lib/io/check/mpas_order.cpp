// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "base/parallel.h"
#include "io/mpas/vertex_order.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

// Applies the free choices of a file to a tessellation: numbers of edges and vertices, starts of
// lists, directions of edges.

namespace calotte::io_detail {
namespace {

/// Replaces column i by column from[i], with its entries in the order turned(i, j).
template <class Columns, class Turned>
void reorder(const Array<std::int32_t>& from, const Turned& turned, Columns& columns) {
  Columns ordered;
  ordered.resize(columns.rows(), columns.cols());
  for_each_block(columns.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      for (Eigen::Index j = 0; j < columns.rows(); ++j)
        ordered(j, i) = columns(turned(i, static_cast<int>(j)), from[i]);
  });
  columns = std::move(ordered);
}

/// Replaces each id by its name.
template <class Ids> void rename(const Array<std::int32_t>& names, Ids& ids) {
  std::int32_t* const all = ids.data();
  for_each_block(ids.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k != end; ++k)
      all[k] = names[all[k]];
  });
}

void number_edges(const MpasNumbering& numbering, Voronoi& out) {
  const auto turned = [&](std::int64_t e, int k) {
    return numbering.reversed[numbering.edge[e]] != 0 ? 1 - k : k;
  };
  reorder(numbering.edge, turned, out.cells_on_edge);
  reorder(numbering.edge, turned, out.vertices_on_edge);
  rename(numbering.file_edge, out.edges_on_vertex);
  rename(numbering.file_edge, out.edges_on_cell.items);
}

void number_vertices(const MpasNumbering& numbering, Voronoi& out) {
  const auto turned = [&](std::int64_t v, int j) {
    return (std::max<int>(numbering.vertex_start[v], 0) + j) % 3;
  };
  reorder(numbering.vertex, turned, out.cells_on_vertex);
  reorder(numbering.vertex, turned, out.edges_on_vertex);
  rename(numbering.file_vertex, out.vertices_on_edge);
  rename(numbering.file_vertex, out.vertices_on_cell.items);
}

// ---- Lists around cells

/// Rotates all lists of a cell so that entry `first` comes first.
void turn_lists(std::int64_t cell, std::ptrdiff_t first, Voronoi& out) {
  for (IdLists* lists : {&out.edges_on_cell, &out.vertices_on_cell, &out.cells_on_cell}) {
    const std::span<std::int32_t> ids = (*lists)[cell];
    std::rotate(ids.begin(), ids.begin() + first, ids.end());
  }
}

/// Starts the lists of each cell at the first id of a variable, if the file has that variable as a
/// table.
/// \param lists of that variable.
/// \param after distance from the first id to the start.
bool take_starts(const std::string& variable, const IdLists& lists, std::ptrdiff_t after,
                 MpasCheck& check) {
  const NetcdfReader& file = check.deviations.file();
  if (!file.has_variable(variable) || !file.is_numeric(variable))
    return false;
  const std::vector<std::int64_t> shape = file.shape_of(variable);
  if (shape.size() != 2 || shape[0] != lists.size() || shape[1] == 0)
    return false;
  check.deviations.visit_rows<std::int32_t>(
      variable, [&](std::int64_t cell, const std::int32_t* row, Differences&) {
        const std::span<const std::int32_t> ids = lists[cell];
        const std::ptrdiff_t first = std::ranges::find(ids, row[0] - 1) - ids.begin();
        if (first < std::ssize(ids)) // an unknown id is reported with the variable
          turn_lists(cell, (first + after) % std::ssize(ids), check.voronoi);
      });
  return true;
}

void start_lists(MpasCheck& check) {
  const Voronoi& of = check.voronoi;
  if (check.has_edges && take_starts(mpas::edges_on_cell, of.edges_on_cell, 0, check))
    return;
  const bool before = read_vertex_order(check.deviations.file()) == VertexOrder::before_edges;
  if (check.has_vertices &&
      take_starts(mpas::vertices_on_cell, of.vertices_on_cell, before ? 1 : 0, check))
    return;
  take_starts(mpas::cells_on_cell, of.cells_on_cell, 0, check);
}

/// Assigns rows of a file that are not in the mesh, or repeat another, to items without a row, so
/// that all other rows and variables are compared, too.
/// \param of_row item of the mesh by row.
/// \param row_of the reverse; -1 for none.
void complete(Array<std::int32_t>& of_row, Array<std::int32_t>& row_of) {
  std::int32_t free = 0;
  for (std::int32_t row = 0; row < of_row.size(); ++row) {
    if (of_row[row] >= 0 && row_of[of_row[row]] == row)
      continue;
    while (row_of[free] >= 0)
      ++free;
    of_row[row] = free;
    row_of[free] = row;
  }
}

} // namespace

void take_numbering(MpasNumbering&& numbering, MpasCheck& check) {
  complete(numbering.edge, numbering.file_edge);
  complete(numbering.vertex, numbering.file_vertex);
  check.has_edges = numbering.edge.size() > 0;
  check.has_vertices = numbering.vertex.size() > 0;
  if (check.has_edges)
    number_edges(numbering, check.voronoi);
  if (check.has_vertices)
    number_vertices(numbering, check.voronoi);
  start_lists(check);
}

} // namespace calotte::io_detail
