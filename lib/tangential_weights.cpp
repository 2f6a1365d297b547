// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/voronoi.h>

#include "connectivity.h"
#include "parallel.h"
#include "room.h"

#include <cmath>
#include <cstdint>
#include <span>

namespace calotte {
namespace detail {
namespace {

std::int64_t degree(const Voronoi& of, std::int32_t cell) {
  return of.begin[cell + 1] - of.begin[cell];
}

/// Sets the weights of a cell's other edges for edge e, counter-clockwise from it on.
/// \param sign 1 where the edge's normal leaves the cell, -1 where it enters it.
/// \param out where the first stands. \returns where the next one will.
std::int64_t set_weights_of_cell(const Voronoi& of, std::int32_t e, std::int32_t cell, double sign,
                                 std::int64_t out, TangentialWeights& weights) {
  const std::int64_t begin = of.begin[cell], end = of.begin[cell + 1];
  std::int64_t place = begin;
  while (of.edges_on_cell[place] != e)
    ++place;
  const double divisor = of.cell_area[cell] * of.dc[e], half = 0.5 * of.cell_area[cell];
  const double scale = std::abs(divisor) > 1e-200 ? 1 / divisor : 0; // no cell is that small
  double passed = 0;
  for (std::int64_t k = end - begin; k > 1; --k) {
    const std::int32_t vertex = of.vertices_on_cell[place];
    passed += of.kites(vertex_at(of.cells_on_vertex, vertex, cell), vertex);
    place = place + 1 == end ? begin : place + 1;
    const std::int32_t other = of.edges_on_cell[place];
    const double side = cell < of.cells_on_cell[place] ? sign : -sign; // out of the lower cell
    weights.edges[out] = other;
    weights.weights[out++] = side * (half - passed) * scale * of.dv[other];
  }
  return out;
}

} // namespace
} // namespace detail

TangentialWeights tangential_weights(const Voronoi& voronoi, std::int64_t first,
                                     std::int64_t last) {
  TangentialWeights out;
  detail::make_room(out.begin, last - first + 1, 1);
  detail::for_each_block(last - first, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k != end; ++k)
      out.begin[k] = detail::degree(voronoi, voronoi.cells_on_edge(0, first + k)) +
                     detail::degree(voronoi, voronoi.cells_on_edge(1, first + k)) - 2;
  });
  out.begin[last - first] = 0;
  const std::int64_t total = detail::exclusive_scan(
      std::span(out.begin.data(), static_cast<std::size_t>(out.begin.size())));
  detail::make_room(out.edges, total, 1);
  detail::make_room(out.weights, total, 1);
  detail::for_each_block(last - first, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k != end; ++k) {
      const auto e = static_cast<std::int32_t>(first + k);
      const std::int64_t next = detail::set_weights_of_cell(voronoi, e, voronoi.cells_on_edge(0, e),
                                                            1, out.begin[k], out);
      detail::set_weights_of_cell(voronoi, e, voronoi.cells_on_edge(1, e), -1, next, out);
    }
  });
  return out;
}

} // namespace calotte
