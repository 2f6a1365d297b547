// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/first_fault.h"
#include "base/message.h"
#include "base/monitor.h"
#include "base/parallel.h"
#include "base/require.h"
#include "partition/connected_parts.h"
#include "partition/graph.h"
#include "partition/metis.h"

#include <calotte/partition.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte {
namespace {

using namespace partition_detail;

void require_weights(const DoubleVector& weights, std::int64_t cells) {
  if (weights.size() == 0)
    return;
  require(weights.size() == cells, "there are {} weights, but {} cells; give one for each cell",
          weights.size(), cells);
  for (std::int64_t i = 0; i < cells; ++i)
    if (!(weights[i] >= 0) || !std::isfinite(weights[i]))
      refuse_at(i, "the weight of cell {} is {}; give finite weights >= 0", weights[i]);
  require(weights.sum() > 0, "all weights are 0; give at least one that is positive");
  require(std::isfinite(weights.sum()), "the sum of the weights is infinite; give smaller ones");
}

void require_parts(std::int64_t parts, std::int64_t cells) {
  if (parts < 1 || parts > cells)
    refuse(
        message("{} cells cannot make {} parts; give a number from 1 to {}", cells, parts, cells),
        parts);
}

/// Partitions one graph into several numbers of parts.
class Partitioner {
public:
  Partitioner(const IdLists& neighbours, const DoubleVector& weights)
      : graph_(make_graph(neighbours)), components_(find_components(graph_)),
        joined_(is_connected() ? Graph() : joined(graph_, components_)), weights_(weights),
        metis_(connected(), weights_) {}

  CellParts partition(std::int64_t parts) const {
    if (parts == 1)
      return measured(std::vector<std::int32_t>(static_cast<std::size_t>(graph_.size())), 1);
    CellParts best = attempt(parts, 0);
    for (int k = 1; k < attempts && !best.balanced; ++k)
      if (CellParts other = attempt(parts, k); other.imbalance < best.imbalance)
        best = std::move(other);
    return best;
  }

private:
  static constexpr int attempts = 4; ///< maximum number, until parts are balanced

  bool is_connected() const { return components_.first.size() == 1; }
  const Graph& connected() const { return is_connected() ? graph_ : joined_; }

  CellParts attempt(std::int64_t parts, int k) const {
    return measured(connected_parts(connected(), weights_, parts, metis_.partition(parts, k)),
                    parts);
  }

  CellParts measured(const std::vector<std::int32_t>& part, std::int64_t parts) const {
    CellParts out;
    out.parts = parts;
    out.edge_cut = edge_cut(graph_, part);
    const std::vector<double> sums = part_weights(part, parts, weights_);
    const double sum = weights_.size() > 0 ? weights_.sum() : static_cast<double>(part.size());
    const double heaviest = *std::max_element(sums.begin(), sums.end()),
                 mean = sum / static_cast<double>(parts);
    out.imbalance = heaviest / mean - 1;
    out.balanced =
        heaviest <= (1 + aimed_imbalance) * mean + (weights_.size() > 0 ? weights_.maxCoeff() : 1);
    out.unconnected = unconnected(part, parts);
    out.part = Eigen::Map<const Ids>(part.data(), std::ssize(part));
    return out;
  }

  std::int64_t unconnected(const std::vector<std::int32_t>& part, std::int64_t parts) const {
    if (is_connected())
      return 0;
    const Components components = find_components(graph_, part);
    std::vector<int> count(static_cast<std::size_t>(parts));
    for (const std::int32_t cell : components.first)
      ++count[static_cast<std::size_t>(part[static_cast<std::size_t>(cell)])];
    return std::count_if(count.begin(), count.end(), [](int n) { return n > 1; });
  }

  Graph graph_;
  Components components_;
  Graph joined_; ///< empty if the graph is connected
  const DoubleVector& weights_;
  Metis metis_;
};

} // namespace

void partition(const IdLists& neighbours, std::span<const std::int64_t> counts,
               const PartitionOptions& options, const std::function<void(CellParts)>& visit) {
  const std::int64_t cells = neighbours.size();
  require(cells > 0, "there are no cells; give the neighbours of at least one");
  require_weights(options.weights, cells);
  for (const std::int64_t parts : counts)
    require_parts(parts, cells);
  const Partitioner partitioner(neighbours, options.weights);
  base_detail::Monitor monitor(options.progress);
  monitor.begin("partition", 1, std::ssize(counts));
  for_each_task(std::ssize(counts), [&](std::int64_t k) {
    visit(partitioner.partition(counts[static_cast<std::size_t>(k)]));
    monitor.step();
  });
  monitor.finish();
}

CellParts partition(const IdLists& neighbours, std::int64_t parts,
                    const PartitionOptions& options) {
  CellParts out;
  partition(neighbours, std::span(&parts, 1), options,
            [&](CellParts made) { out = std::move(made); });
  return out;
}

std::vector<std::int64_t> component_sizes(const IdLists& neighbours) {
  const Components components = find_components(make_graph(neighbours));
  std::vector<std::int64_t> sizes(components.first.size());
  for (const std::int32_t component : components.of)
    ++sizes[static_cast<std::size_t>(component)];
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  return sizes;
}

} // namespace calotte
