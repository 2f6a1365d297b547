// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "partition/room.h"

#include <calotte/matrices.h>

#include <cstdint>
#include <span>
#include <vector>

namespace calotte::partition_detail {

/// The neighbours of each cell: ascending, each once, mutual, never the cell itself.
using Graph = Lists<std::vector<std::int32_t>, std::vector<std::int64_t>>;

/// \throws Error invalid_argument as partition(), for neighbours.
Graph graph_of(const IdLists& neighbours);

/// The connected components of cells, numbered by their lowest cell.
struct Components {
  std::vector<std::int32_t> of;    ///< by cell
  std::vector<std::int32_t> first; ///< lowest cell, by component
};

/// \param part of each cell: only neighbours of the same part are connected. Empty: all are.
Components components_of(const Graph& graph, std::span<const std::int32_t> part = {});

/// The graph with one more edge for each component but the first, from its lowest cell to the cell
/// before that one: the graph is then connected. Cells whose numbers are close are close in most
/// meshes. Such an edge is the last of its lists.
Graph joined(const Graph& graph, const Components& components);

/// Pairs of neighbours in different parts.
std::int64_t edge_cut(const Graph& graph, std::span<const std::int32_t> part);

} // namespace calotte::partition_detail
