// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/graph.h"

#include "base/first_fault.h"
#include "base/lists.h"
#include "base/message.h"
#include "base/parallel.h"
#include "base/require.h"

#include <algorithm>
#include <cstddef>

namespace calotte::partition_detail {
namespace {

using base_detail::exclusive_scan, base_detail::lists_by_key;

/// Sets `out` to the neighbours of a cell as a Graph has them.
void gather(const IdLists& neighbours, std::int64_t cell, std::vector<std::int32_t>& out) {
  out.clear();
  for (const std::int32_t id : neighbours[cell])
    if (id >= 0 && id != cell)
      out.push_back(id);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

/// Calls body(cell, neighbours of the cell) for all cells, in parallel.
template <class Body> void for_each_cell(const IdLists& neighbours, const Body& body) {
  for_each_block(neighbours.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::vector<std::int32_t> list;
    for (std::int64_t i = begin; i != end; ++i) {
      gather(neighbours, i, list);
      body(i, list);
    }
  });
}

void require_ids(const IdLists& neighbours) {
  const std::int64_t cells = neighbours.size();
  FirstFault fault;
  for_each_block(cells, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      for (const std::int32_t id : neighbours[i])
        if (id < -1 || id >= cells)
          fault.at(i);
  });
  fault.refuse("cell",
               message("has a neighbour that is not one of the {} cells; number them from 0, "
                       "and give -1 for none",
                       cells));
}

void require_mutual(const Graph& graph) {
  FirstFault fault;
  for_each_block(graph.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      for (const std::int32_t id : graph[i])
        if (!std::binary_search(graph[id].begin(), graph[id].end(), static_cast<std::int32_t>(i)))
          fault.at(i);
  });
  fault.refuse("cell", "has a neighbour that does not have it as a neighbour; give both");
}

} // namespace

Graph make_graph(const IdLists& neighbours) {
  const std::int64_t cells = neighbours.size();
  require_count(cells, 1, "the number of cells");
  require_ids(neighbours);
  Graph graph;
  graph.begin.resize(static_cast<std::size_t>(cells) + 1);
  for_each_cell(neighbours, [&](std::int64_t i, const std::vector<std::int32_t>& list) {
    graph.begin[static_cast<std::size_t>(i)] = std::ssize(list);
  });
  graph.items.resize(static_cast<std::size_t>(exclusive_scan(std::span(graph.begin))));
  for_each_cell(neighbours, [&](std::int64_t i, const std::vector<std::int32_t>& list) {
    std::copy(list.begin(), list.end(), graph[i].begin());
  });
  require_mutual(graph);
  return graph;
}

Components find_components(const Graph& graph, std::span<const std::int32_t> part) {
  const auto cells = static_cast<std::size_t>(graph.size());
  Components out{std::vector<std::int32_t>(cells, -1), {}};
  std::vector<std::int32_t> reached;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (out.of[cell] >= 0)
      continue;
    const auto component = static_cast<std::int32_t>(out.first.size());
    out.first.push_back(static_cast<std::int32_t>(cell));
    out.of[cell] = component;
    reached.assign(1, static_cast<std::int32_t>(cell));
    while (!reached.empty()) {
      const std::int32_t from = reached.back();
      reached.pop_back();
      for (const std::int32_t id : graph[from]) {
        const auto to = static_cast<std::size_t>(id);
        if (out.of[to] >= 0 || (!part.empty() && part[to] != part[cell]))
          continue;
        out.of[to] = component;
        reached.push_back(id);
      }
    }
  }
  return out;
}

Graph joined(const Graph& graph, const Components& components) {
  return lists_by_key<std::vector<std::int32_t>>(graph.size(), [&](const auto& put) {
    for (std::int64_t cell = 0; cell < graph.size(); ++cell)
      for (const std::int32_t id : graph[cell])
        put(cell, id);
    for (std::size_t k = 1; k < components.first.size(); ++k) {
      const std::int32_t cell = components.first[k];
      put(cell, cell - 1);
      put(cell - 1, cell);
    }
  });
}

std::int64_t edge_cut(const Graph& graph, std::span<const std::int32_t> part) {
  std::int64_t cut = 0;
  for (std::int64_t i = 0; i < graph.size(); ++i)
    for (const std::int32_t id : graph[i])
      cut += id > i && part[static_cast<std::size_t>(id)] != part[static_cast<std::size_t>(i)];
  return cut;
}

} // namespace calotte::partition_detail
