// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas/vertex_order.h"

#include "io/mpas/mpas_variables.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace calotte::io_detail {
namespace {

/// The lists of one cell.
struct CellRow {
  std::vector<std::int32_t> edges, vertices; ///< 1-based
  std::int64_t count = 0;

  std::int32_t vertex(std::int64_t k) const {
    return vertices[static_cast<std::size_t>((k + count) % count)];
  }
};

bool joins(const std::array<std::int32_t, 2>& ends, std::int32_t a, std::int32_t b) {
  return (ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a);
}

/// None if no edge determines the order: ids are missing, or no vertices match.
std::optional<VertexOrder> find_order(const NetcdfReader& file, const CellRow& cell) {
  const std::int64_t edges = file.dimension(mpas_edge.dimension());
  for (std::int64_t k = 0; k < cell.count; ++k) {
    const std::int32_t e = cell.edges[static_cast<std::size_t>(k)];
    if (e < 1 || e > edges)
      continue;
    std::array<std::int32_t, 2> ends{};
    file.rows(mpas::vertices_on_edge, e - 1, 1, ends.data());
    const bool after = joins(ends, cell.vertex(k - 1), cell.vertex(k)),
               before = joins(ends, cell.vertex(k), cell.vertex(k + 1));
    if (after != before)
      return after ? VertexOrder::after_edges : VertexOrder::before_edges;
  }
  return std::nullopt;
}

bool has_lists(const NetcdfReader& file) {
  for (const char* name : {mpas::n_edges_on_cell, mpas::edges_on_cell, mpas::vertices_on_cell})
    if (!file.has_variable(name) || !file.is_integer(name))
      return false;
  const std::int64_t cells = file.dimension(mpas_cell.dimension()),
                     edges = file.dimension(mpas_edge.dimension());
  const std::vector<std::int64_t> shape = file.shape_of(mpas::vertices_on_cell);
  return file.has_variable(mpas::vertices_on_edge) && file.is_integer(mpas::vertices_on_edge) &&
         file.shape_of(mpas::vertices_on_edge) == std::vector<std::int64_t>{edges, 2} &&
         file.shape_of(mpas::n_edges_on_cell) == std::vector<std::int64_t>{cells} &&
         shape.size() == 2 && shape.front() == cells && file.shape_of(mpas::edges_on_cell) == shape;
}

} // namespace

VertexOrder read_vertex_order(const NetcdfReader& file) {
  if (!has_lists(file))
    return VertexOrder::after_edges;
  const std::vector<std::int64_t> shape = file.shape_of(mpas::vertices_on_cell);
  const auto width = static_cast<std::size_t>(shape.back());
  CellRow cell{std::vector<std::int32_t>(width), std::vector<std::int32_t>(width), 0};
  for (std::int64_t i = 0; i < shape.front(); ++i) {
    std::int32_t count = 0;
    file.rows(mpas::n_edges_on_cell, i, 1, &count);
    if (count < 3 || count > shape.back())
      continue;
    cell.count = count;
    file.rows(mpas::edges_on_cell, i, 1, cell.edges.data());
    file.rows(mpas::vertices_on_cell, i, 1, cell.vertices.data());
    if (const std::optional<VertexOrder> order = find_order(file, cell))
      return *order;
  }
  return VertexOrder::after_edges;
}

std::string described(VertexOrder order) {
  return std::string("vertices of each cell, counter-clockwise: edge k of edgesOnCell lies between "
                     "vertices ") +
         (order == VertexOrder::after_edges ? "k - 1 and k" : "k and k + 1") + index_base;
}

} // namespace calotte::io_detail
