// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

#include <calotte/voronoi.h>

#include <cstdint>

namespace calotte::voronoi_detail {

/// The number of an edge's tangential weights, one for each other edge of its cells.
inline std::int64_t weight_count(const Voronoi& of, std::int64_t edge) {
  std::int64_t count = 0;
  for (const std::int32_t cell : of.cells_on_edge.col(edge))
    count += cell < 0 ? 0 : of.edges_on_cell.count(cell) - 1;
  return count;
}

/// Sets the weights and their edges from index 0 on, in the order of TangentialWeights.
/// \param edges, weights have space for weight_count() each.
void set_weights(const Voronoi& of, std::int32_t edge, std::int32_t* edges, double* weights);

} // namespace calotte::voronoi_detail
