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
Graph make_graph(const IdLists& neighbours);

/// The connected components of cells, numbered by their lowest cell.
struct Components {
  std::vector<std::int32_t> of;    ///< component of each cell
  std::vector<std::int32_t> first; ///< lowest cell of each component
};

/// The connected components.
/// \param part of each cell: only neighbours in the same part are connected. Empty: all neighbours
///        are.
Components find_components(const Graph& graph, std::span<const std::int32_t> part = {});

/// Connects a graph: adds one edge for each component but the first, from its lowest cell to the
/// preceding cell. In most meshes, cells with close numbers are close. These edges are the last
/// ones of their lists.
Graph joined(const Graph& graph, const Components& components);

/// The number of pairs of neighbours in different parts.
std::int64_t edge_cut(const Graph& graph, std::span<const std::int32_t> part);

} // namespace calotte::partition_detail
