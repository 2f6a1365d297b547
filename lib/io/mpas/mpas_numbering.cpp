// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas/mpas_numbering.h"
#include "base/message.h"
#include "io/mpas/mpas_variables.h"

#include <algorithm>
#include <utility>

namespace calotte::io_detail {
namespace {

Array<std::int32_t> unknown_ids(std::int64_t count) {
  Array<std::int32_t> ids(count);
  std::fill(ids.begin(), ids.end(), -1);
  return ids;
}

/// The first column in which each cell is the lowest. Such columns are consecutive.
/// \pre columns start with their lowest cell, and are sorted.
template <class Columns>
Array<std::int32_t> find_starts(const Columns& columns, std::int64_t cells) {
  Array<std::int32_t> start(cells + 1);
  std::int32_t column = 0;
  for (std::int32_t cell = 0; cell < cells; ++cell) {
    start[cell] = column;
    while (column < columns.cols() && columns(0, column) == cell)
      ++column;
  }
  start[cells] = static_cast<std::int32_t>(columns.cols());
  return start;
}

bool are_cells(const std::int32_t* ids, int count, std::int64_t cells) {
  return std::all_of(ids, ids + count, [=](std::int32_t id) { return 1 <= id && id <= cells; });
}

/// Finds vertices and edges of the tessellation by their cells.
struct Finder {
  const Voronoi& voronoi;
  Array<std::int32_t> triangles = find_starts(voronoi.cells_on_vertex, voronoi.cells.cols());
  Array<std::int32_t> edges = find_starts(voronoi.cells_on_edge, voronoi.cells.cols());

  /// The vertex of three cells, of which the first is the lowest; -1 if there is none.
  std::int32_t vertex(std::int32_t a, std::int32_t b, std::int32_t c) const {
    for (std::int32_t t = triangles[a]; t < triangles[a + 1]; ++t)
      if (voronoi.cells_on_vertex(1, t) == b && voronoi.cells_on_vertex(2, t) == c)
        return t;
    return -1;
  }

  std::int32_t edge(std::int32_t a, std::int32_t b) const {
    const auto [low, high] = std::minmax(a, b);
    for (std::int32_t e = edges[low]; e < edges[low + 1]; ++e)
      if (voronoi.cells_on_edge(1, e) == high)
        return e;
    return -1;
  }
};

// ---- Vertices

/// A vertex of the file, which may run clockwise.
struct FoundVertex {
  std::int32_t vertex = -1;
  std::int8_t start = -1; ///< -1 if clockwise
};

FoundVertex found_vertex(const Finder& finder, const std::int32_t* ids) {
  if (!are_cells(ids, 3, finder.voronoi.cells.cols()))
    return {};
  const auto lowest = std::min_element(ids, ids + 3) - ids;
  const std::int32_t a = ids[lowest] - 1, b = ids[(lowest + 1) % 3] - 1,
                     c = ids[(lowest + 2) % 3] - 1;
  const std::int32_t vertex = finder.vertex(a, b, c);
  return vertex >= 0 ? FoundVertex{vertex, static_cast<std::int8_t>((3 - lowest) % 3)}
                     : FoundVertex{finder.vertex(a, c, b), -1};
}

void number_vertices(const Finder& finder, Deviations& deviations, MpasNumbering& out) {
  const Differences clockwise = deviations.visit_rows<std::int32_t>(
      mpas::cells_on_vertex,
      [&](std::int64_t row, const std::int32_t* ids, Differences& differences) {
        const FoundVertex found = found_vertex(finder, ids);
        out.vertex[row] = found.vertex;
        out.vertex_start[row] = found.start;
        if (found.vertex >= 0)
          out.file_vertex[found.vertex] = static_cast<std::int32_t>(row);
        if (found.start < 0)
          differences.note(3 * row + 1, ids[1], ids[2], 1);
      });
  deviations.add(mpas::cells_on_vertex, clockwise, mpas_variable(mpas::cells_on_vertex).rule);
}

// ---- Edges

/// Finds the edges of the file. Does not check that an edge occurs once.
Differences find_edges(const Finder& finder, const Deviations& deviations,
                       Array<std::int32_t>& edge) {
  return deviations.visit_rows<std::int32_t>(
      mpas::cells_on_edge,
      [&](std::int64_t row, const std::int32_t* ids, Differences& differences) {
        const bool cells = are_cells(ids, 2, finder.voronoi.cells.cols());
        edge[row] = cells ? finder.edge(ids[0] - 1, ids[1] - 1) : -1;
        if (edge[row] < 0)
          differences.note(2 * row, ids[0], 0, 1);
        else // a negative sign marks a reversed edge for the caller
          edge[row] = ids[0] < ids[1] ? edge[row] : -2 - edge[row];
      });
}

/// Sets the edges of the tessellation by those of the file. Serial, so that the first of two equal
/// edges counts.
Differences invert_edges(const Voronoi& voronoi, MpasNumbering& out) {
  Differences twice;
  for (std::int64_t row = 0; row < out.edge.size(); ++row) {
    if (out.edge[row] == -1)
      continue;
    const bool reversed = out.edge[row] < 0;
    const std::int32_t e = reversed ? -2 - out.edge[row] : out.edge[row];
    if (out.file_edge[e] >= 0) {
      twice.note(2 * row, voronoi.cells_on_edge(reversed ? 1 : 0, e) + 1, 0, 1);
      out.edge[row] = -1;
      continue;
    }
    out.edge[row] = e;
    out.file_edge[e] = static_cast<std::int32_t>(row);
    out.reversed[e] = reversed;
  }
  return twice;
}

void number_edges(const Finder& finder, Deviations& deviations, MpasNumbering& out) {
  Differences differences = find_edges(finder, deviations, out.edge);
  differences.take(invert_edges(finder.voronoi, out));
  deviations.add(mpas::cells_on_edge, differences, mpas_variable(mpas::cells_on_edge).rule);
}

/// Whether a dimension of the file is that of the mesh.
bool is_whole(const std::string& dimension, std::int64_t size, Deviations& deviations) {
  const std::int64_t stored = deviations.file().dimension(dimension);
  if (stored != size && stored >= 0)
    deviations.add(dimension, message("{} is {}, but the mesh has {}", dimension, stored, size));
  return stored == size;
}

} // namespace

MpasNumbering find_numbering(const Voronoi& voronoi, Deviations& deviations) {
  const std::int64_t vertices = voronoi.cells_on_vertex.cols(),
                     edges = voronoi.cells_on_edge.cols();
  const Finder finder{voronoi};
  MpasNumbering out;
  if (is_whole(mpas_vertex.dimension(), vertices, deviations) &&
      deviations.has(mpas::cells_on_vertex, {vertices, 3})) {
    out.vertex = unknown_ids(vertices);
    out.vertex_start = Array<std::int8_t>(vertices);
    out.file_vertex = unknown_ids(vertices);
    number_vertices(finder, deviations, out);
  }
  if (is_whole(mpas_edge.dimension(), edges, deviations) &&
      deviations.has(mpas::cells_on_edge, {edges, 2})) {
    out.edge = unknown_ids(edges);
    out.file_edge = unknown_ids(edges);
    out.reversed = Array<std::uint8_t>(edges);
    std::fill(out.reversed.begin(), out.reversed.end(), std::uint8_t{0});
    number_edges(finder, deviations, out);
  }
  return out;
}

} // namespace calotte::io_detail
