// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/mpas_check.h"

#include "io/mpas/vertex_order.h"
#include "voronoi/tangential_weights.h"

#include <algorithm>
#include <span>
#include <string>

// Lists of ids around cells, edges and vertices. Those of the tessellation are the rule; where a
// cyclic list starts is the file's choice, which its other lists around the same cell follow.

namespace calotte::io_detail {
namespace {

constexpr std::int32_t unknown = -1;

/// 1-based; 0 for an id that the file does not have.
std::int32_t stored_id(const Array<std::int32_t>& of_file, std::int32_t id) {
  return of_file[id] + 1;
}

// ---- Around cells

/// One of the lists around cells, in the numbering of the file.
struct CellLists {
  std::string variable;
  const IdLists& ids;
  const Array<std::int32_t>* of_file; ///< null for cells, which keep their numbers
  std::int32_t offset = 0;            ///< of the first entry, in lists that start with an edge

  std::int32_t stored(std::int32_t id) const { return of_file ? stored_id(*of_file, id) : id + 1; }
};

/// Compares a row from a known place of the tessellation's list on.
void compare_row(const CellLists& lists, std::int64_t cell, std::int64_t start,
                 const std::int32_t* row, std::int64_t width, Differences& differences) {
  const std::span<const std::int32_t> ids = lists.ids[cell];
  const std::int64_t count = std::ssize(ids);
  for (std::int64_t k = 0; k < width; ++k) {
    const std::int32_t derived =
        k < count ? lists.stored(ids[static_cast<std::size_t>((start + count + k) % count)]) : 0;
    if (k >= count || derived != 0) // others are reported with cellsOnEdge
      differences.compare(cell * width + k, row[k], derived);
  }
  if (count > width)
    differences.note(cell * width, static_cast<double>(width), static_cast<double>(count), 1);
}

/// Where in the tessellation's lists those of the file start, by a row's first id, or unknown.
std::int32_t start_of(const CellLists& lists, std::int64_t cell, std::int32_t id) {
  const std::span<const std::int32_t> ids = lists.ids[cell];
  const auto count = static_cast<std::int32_t>(ids.size());
  for (std::int32_t k = 0; k < count; ++k)
    if (lists.stored(ids[static_cast<std::size_t>(k)]) == id)
      return (k + count - lists.offset) % count;
  return unknown;
}

/// \param starts of each cell's lists; unknown ones are set from this variable.
void check_cell_lists(const MpasCheck& check, const CellLists& lists, Array<std::int32_t>& starts) {
  if (!check.has(lists.variable))
    return;
  const std::int64_t width = check.deviations.width(lists.variable);
  const Differences differences = check.deviations.visit_rows<std::int32_t>(
      lists.variable, [&](std::int64_t cell, const std::int32_t* row, Differences& out) {
        if (starts[cell] == unknown && width > 0)
          starts[cell] = start_of(lists, cell, row[0]);
        compare_row(lists, cell, std::max(starts[cell], 0) + lists.offset, row, width, out);
      });
  check.add(lists.variable, differences);
}

void check_around_cells(const MpasCheck& check) {
  const Voronoi& voronoi = check.voronoi;
  Array<std::int32_t> starts(voronoi.cells.cols());
  std::fill(starts.begin(), starts.end(), unknown);
  if (check.has_edges())
    check_cell_lists(
        check, {mpas::edges_on_cell, voronoi.edges_on_cell, &check.numbering.file_edge}, starts);
  if (check.has_vertices())
    check_cell_lists(
        check,
        {mpas::vertices_on_cell, voronoi.vertices_on_cell, &check.numbering.file_vertex,
         vertex_order_of(check.deviations.file()) == VertexOrder::before_edges ? -1 : 0},
        starts);
  check_cell_lists(check, {mpas::cells_on_cell, voronoi.cells_on_cell, nullptr}, starts);
}

// ---- At edges and vertices

void check_vertices_on_edges(const MpasCheck& check) {
  const Voronoi& voronoi = check.voronoi;
  const MpasNumbering& numbering = check.numbering;
  if (!check.has_vertices() || !check.has_edges() || !check.has(mpas::vertices_on_edge))
    return;
  check.add(
      mpas::vertices_on_edge,
      check.deviations.visit_rows<std::int32_t>(
          mpas::vertices_on_edge, [&](std::int64_t row, const std::int32_t* ids, Differences& out) {
            const std::int32_t e = numbering.edge[row];
            for (int k = 0; e >= 0 && k < 2; ++k)
              out.compare(
                  2 * row + k, ids[k],
                  stored_id(numbering.file_vertex,
                            voronoi.vertices_on_edge(numbering.reversed[e] ? 1 - k : k, e)));
          }));
}

void check_edges_on_vertices(const MpasCheck& check) {
  const Voronoi& voronoi = check.voronoi;
  const MpasNumbering& numbering = check.numbering;
  if (!check.has_vertices() || !check.has_edges() || !check.has(mpas::edges_on_vertex))
    return;
  check.add(
      mpas::edges_on_vertex,
      check.deviations.visit_rows<std::int32_t>(
          mpas::edges_on_vertex, [&](std::int64_t row, const std::int32_t* ids, Differences& out) {
            const int start = numbering.vertex_start[row];
            for (int k = 0; start >= 0 && k < 3; ++k) {
              const std::int32_t e =
                  voronoi.edges_on_vertex((start + k) % 3, numbering.vertex[row]);
              if (numbering.file_edge[e] >= 0)
                out.compare(3 * row + k, ids[k], stored_id(numbering.file_edge, e));
            }
          }));
}

// ---- Weights

/// The edges and weights of an edge of the file, in its order and with its signs.
struct EdgeWeights {
  std::vector<std::int32_t> edges; ///< of the tessellation
  std::vector<double> values;
  std::int64_t shift = 0, count = 0;
  std::int32_t own = 0; ///< the edge
  bool reversed = false;

  void set(const MpasCheck& check, std::int32_t e) {
    const Voronoi& voronoi = check.voronoi;
    own = e;
    count = voronoi_detail::weight_count(voronoi, e);
    if (std::ssize(edges) < count) {
      edges.resize(static_cast<std::size_t>(count));
      values.resize(static_cast<std::size_t>(count));
    }
    voronoi_detail::set_weights(voronoi, e, edges.data(), values.data());
    reversed = check.numbering.reversed[e];
    const std::int32_t first = voronoi.cells_on_edge(0, e);
    shift = reversed ? voronoi.edges_on_cell.count(first) - 1 : 0;
  }
  std::size_t place(std::int64_t k) const { return static_cast<std::size_t>((k + shift) % count); }
  std::int32_t edge(std::int64_t k) const { return edges[place(k)]; }
  /// Both normals have the directions of the file.
  double weight(const MpasCheck& check, std::int64_t k) const {
    const double value = values[place(k)];
    return reversed != (check.numbering.reversed[edge(k)] != 0) ? -value : value;
  }
};

/// Compares the rows of edges; compare(place, stored, weights, k, differences) for the entries of
/// each, and the padding with 0.
template <class T, class Compare>
Differences visit_weights(const MpasCheck& check, const std::string& variable,
                          const Compare& compare) {
  const std::int64_t width = check.deviations.width(variable);
  return check.deviations.visit_blocks<T>(
      variable, [&](std::int64_t begin, std::int64_t end, const T* row, Differences& out) {
        EdgeWeights weights;
        for (std::int64_t e = begin; e != end; ++e, row += width) {
          if (check.numbering.edge[e] < 0)
            continue;
          if (!check.has_weights(check.numbering.edge[e])) { // any numbers may stand there
            for (std::int64_t k = 0; k < width; ++k)
              if (row[k] != row[k])
                out.note(e * width + k, static_cast<double>(row[k]), 0, 1);
            continue;
          }
          weights.set(check, check.numbering.edge[e]);
          for (std::int64_t k = 0; k < width; ++k)
            if (k < weights.count)
              compare(e * width + k, row[k], weights, k, out);
            else if (row[k] != 0)
              out.note(e * width + k, row[k], 0, 1);
          if (weights.count > width)
            out.note(e * width, static_cast<double>(width), static_cast<double>(weights.count), 1);
        }
      });
}

} // namespace

void check_mpas_lists(const MpasCheck& check) {
  check_around_cells(check);
  check_vertices_on_edges(check);
  check_edges_on_vertices(check);
}

void check_mpas_weights(const MpasCheck& check) {
  const Voronoi& voronoi = check.voronoi;
  if (!check.has_edges())
    return;
  if (check.has(mpas::edges_on_edge))
    check.add(mpas::edges_on_edge,
              visit_weights<std::int32_t>(
                  check, mpas::edges_on_edge,
                  [&](std::int64_t place, std::int32_t stored, const EdgeWeights& weights,
                      std::int64_t k, Differences& out) {
                    const std::int32_t e = check.numbering.file_edge[weights.edge(k)];
                    if (e >= 0)
                      out.compare(place, stored, e + 1);
                  }));
  if (check.has(mpas::weights_on_edge))
    check.add(mpas::weights_on_edge,
              visit_weights<double>(
                  check, mpas::weights_on_edge,
                  [&](std::int64_t place, double stored, const EdgeWeights& weights, std::int64_t k,
                      Differences& out) {
                    const std::int32_t other = weights.edge(k);
                    out.compare(place, stored, weights.weight(check, k),
                                (voronoi.dv[other] + voronoi.dc[other]) / voronoi.dc[weights.own],
                                check.tolerance);
                  }));
}

} // namespace calotte::io_detail
