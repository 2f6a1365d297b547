// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

#include <calotte/voronoi.h>

#include <cstdint>

namespace calotte::voronoi_detail {

/// The number of an edge's tangential weights.
inline std::int64_t weight_count(const Voronoi& of, std::int64_t edge) {
  const std::int32_t a = of.cells_on_edge(0, edge), b = of.cells_on_edge(1, edge);
  return of.begin[a + 1] - of.begin[a] + of.begin[b + 1] - of.begin[b] - 2;
}

/// Sets the weights and their edges from index 0 on, in the order of TangentialWeights.
/// \param edges, weights have space for weight_count() each.
void set_weights(const Voronoi& of, std::int32_t edge, std::int32_t* edges, double* weights);

} // namespace calotte::voronoi_detail
