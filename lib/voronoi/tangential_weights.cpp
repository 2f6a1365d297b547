// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/tangential_weights.h"

#include "base/parallel.h"
#include "voronoi/connectivity.h"

#include <cmath>
#include <span>

namespace calotte {
namespace voronoi_detail {
namespace {

/// Sets the weights of a cell's other edges for an edge, counter-clockwise from that edge.
/// \param sign 1 if the edge's normal leaves the cell, -1 if it enters it.
/// \returns the number of weights.
std::int64_t set_weights_of_cell(const Voronoi& of, std::int32_t edge, std::int32_t cell,
                                 double sign, std::int32_t* edges, double* weights) {
  const std::span<const std::int32_t> on_cell = of.edges_on_cell[cell];
  std::size_t index = 0;
  while (on_cell[index] != edge)
    ++index;
  const double divisor = of.cell_area[cell] * of.dc[edge], half = 0.5 * of.cell_area[cell];
  const double scale = std::abs(divisor) > 1e-200 ? 1 / divisor : 0; // no cell is that small
  double passed = 0;
  for (std::size_t k = 0; k + 1 < on_cell.size(); ++k) {
    const std::int32_t vertex = of.vertices_on_cell[cell][index];
    passed += of.kites(vertex_at(of.cells_on_vertex, vertex, cell), vertex);
    index = index + 1 == on_cell.size() ? 0 : index + 1;
    const std::int32_t other = on_cell[index];
    const double side = of.cells_on_edge(0, other) == cell ? sign : -sign;
    edges[k] = other;
    weights[k] = side * (half - passed) * scale * of.dv[other];
  }
  return std::ssize(on_cell) - 1;
}

} // namespace

void set_weights(const Voronoi& of, std::int32_t edge, std::int32_t* edges, double* weights) {
  const std::int64_t count =
      set_weights_of_cell(of, edge, of.cells_on_edge(0, edge), 1, edges, weights);
  if (const std::int32_t other = of.cells_on_edge(1, edge); other >= 0)
    set_weights_of_cell(of, edge, other, -1, edges + count, weights + count);
}

} // namespace voronoi_detail

TangentialWeights tangential_weights(const Voronoi& voronoi, std::int64_t first,
                                     std::int64_t last) {
  TangentialWeights out;
  Offsets& begins = out.edges.begin;
  begins.resize(last - first + 1);
  base_detail::for_each_block(last - first,
                              [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                                for (std::int64_t k = begin; k != end; ++k)
                                  begins[k] = voronoi_detail::weight_count(voronoi, first + k);
                              });
  begins[last - first] = 0;
  const std::int64_t total = base_detail::exclusive_scan(
      std::span(begins.data(), static_cast<std::size_t>(begins.size())));
  out.edges.items.resize(total);
  out.weights.resize(total);
  base_detail::for_each_block(
      last - first, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k != end; ++k)
          voronoi_detail::set_weights(voronoi, static_cast<std::int32_t>(first + k),
                                      out.edges[k].data(), out.weights.data() + begins[k]);
      });
  return out;
}

} // namespace calotte
