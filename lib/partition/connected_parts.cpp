// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/connected_parts.h"

#include "base/lists.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace calotte::partition_detail {
namespace {

using base_detail::lists_by_key;

using Members = Lists<std::vector<std::int32_t>, std::vector<std::int64_t>>;

std::size_t at(std::int32_t id) { return static_cast<std::size_t>(id); }

double weight_of(const DoubleVector& weights, std::int32_t cell) {
  return weights.size() == 0 ? 1 : weights[cell];
}

Members members_of(const std::vector<std::int32_t>& group, std::int64_t groups) {
  return lists_by_key<std::vector<std::int32_t>>(groups, [&](const auto& put) {
    for (std::size_t cell = 0; cell < group.size(); ++cell)
      put(group[cell], static_cast<std::int32_t>(cell));
  });
}

// ---- Components of parts

/// The components of parts, of which each part shall keep the heaviest.
class Fragments {
public:
  Fragments(const Graph& graph, const DoubleVector& weights, std::int64_t parts,
            Components components, std::vector<std::int32_t>& part)
      : graph_(graph), part_(part), parts_(std::move(components)),
        cells_(members_of(parts_.of, std::ssize(parts_.first))), weights_(parts_.first.size()),
        kept_(parts_.first.size()), of_part_(part_weights(part, parts, weights)),
        limit_((1 + aimed_imbalance) * std::accumulate(of_part_.begin(), of_part_.end(), 0.0) /
               static_cast<double>(parts)) {
    for (std::size_t k = 0; k < weights_.size(); ++k)
      for (const std::int32_t cell : cells_[static_cast<std::int64_t>(k)])
        weights_[k] += weight_of(weights, cell);
    keep_heaviest(parts);
  }

  /// Moves all others. As the graph is connected, one of them has a neighbour that stays.
  void move_others() {
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < kept_.size(); ++k)
      if (!kept_[k])
        left.push_back(k);
    while (!left.empty())
      std::erase_if(left, [&](std::size_t k) { return move(k); });
  }

private:
  void keep_heaviest(std::int64_t parts) {
    std::vector<std::int32_t> heaviest(static_cast<std::size_t>(parts), -1);
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      std::int32_t& best = heaviest[at(part_[at(parts_.first[k])])];
      if (best < 0 || is_heavier(k, at(best)))
        best = static_cast<std::int32_t>(k);
    }
    for (const std::int32_t k : heaviest)
      if (k >= 0)
        kept_[at(k)] = true;
  }

  /// By weight, then by cells, as weights may be 0.
  bool is_heavier(std::size_t a, std::size_t b) const {
    return std::pair(weights_[a], count(a)) > std::pair(weights_[b], count(b));
  }

  std::int64_t count(std::size_t k) const { return cells_.count(static_cast<std::int64_t>(k)); }

  /// Moves a component to a neighbouring part; false where none of its neighbours stays.
  bool move(std::size_t k) {
    std::unordered_map<std::int32_t, std::int64_t> edges; // by part
    for (const std::int32_t cell : cells_[static_cast<std::int64_t>(k)])
      for (const std::int32_t id : graph_[cell])
        if (kept_[at(parts_.of[at(id)])] && at(parts_.of[at(id)]) != k)
          ++edges[part_[at(id)]];
    if (edges.empty())
      return false;
    const auto best =
        std::max_element(edges.begin(), edges.end(), [&](const auto& a, const auto& b) {
          return rank(k, a.first, a.second) < rank(k, b.first, b.second);
        });
    const std::int32_t to = best->first, from = part_[at(parts_.first[k])];
    for (const std::int32_t cell : cells_[static_cast<std::int64_t>(k)])
      part_[at(cell)] = to;
    of_part_[at(from)] -= weights_[k];
    of_part_[at(to)] += weights_[k];
    kept_[k] = true;
    return true;
  }

  /// Of a part for a component: within the limit, then by edges, the lightest, the lowest.
  std::tuple<bool, std::int64_t, double, std::int32_t> rank(std::size_t k, std::int32_t part,
                                                            std::int64_t edges) const {
    const bool own = part == part_[at(parts_.first[k])];
    const double weight = of_part_[at(part)] + (own ? 0 : weights_[k]);
    return {weight <= limit_, edges, -weight, -part};
  }

  const Graph& graph_;
  std::vector<std::int32_t>& part_;
  Components parts_;
  Members cells_;               ///< by component
  std::vector<double> weights_; ///< by component
  std::vector<bool> kept_;      ///< by component: connected with the rest of its part
  std::vector<double> of_part_; ///< weights
  double limit_;                ///< of the weight of a part
};

// ---- Parts without cells

/// A part of several cells, which may be split. The greatest is the heaviest.
struct Divisible {
  double weight;
  std::int64_t cells;
  std::int32_t part;

  bool operator<(const Divisible& other) const {
    return std::tuple(weight, cells, -part) < std::tuple(other.weight, other.cells, -other.part);
  }
};

/// The cells of a connected part from its lowest cell on, each after the one that it was reached
/// from, and the index of that one.
struct Tree {
  std::vector<std::int32_t> cells, parent;
};

Tree tree_of(const Graph& graph, const std::vector<std::int32_t>& part, std::int32_t root,
             std::vector<bool>& seen) {
  Tree tree{{root}, {-1}};
  seen[at(root)] = true;
  for (std::size_t k = 0; k < tree.cells.size(); ++k)
    for (const std::int32_t id : graph[tree.cells[k]])
      if (part[at(id)] == part[at(root)] && !seen[at(id)]) {
        seen[at(id)] = true;
        tree.cells.push_back(id);
        tree.parent.push_back(static_cast<std::int32_t>(k));
      }
  for (const std::int32_t cell : tree.cells)
    seen[at(cell)] = false;
  return tree;
}

/// Gives the branch of a tree that is nearest to half of its weight to another part. Both the
/// branch and the rest are connected. \pre the tree has several cells
void split(const Tree& tree, const DoubleVector& weights, std::int32_t to,
           std::vector<std::int32_t>& part) {
  const std::size_t count = tree.cells.size();
  std::vector<double> branch(count); // a small share of each cell splits cells of no weight, too
  double whole = 0;
  for (const std::int32_t cell : tree.cells)
    whole += weight_of(weights, cell);
  const double share = whole > 0 ? 1e-9 * whole / static_cast<double>(count) : 1;
  for (std::size_t k = count; k-- > 0;) {
    branch[k] += weight_of(weights, tree.cells[k]) + share;
    if (k > 0)
      branch[at(tree.parent[k])] += branch[k];
  }
  const double half = branch[0] / 2;
  const auto best = std::min_element(branch.begin() + 1, branch.end(), [&](double a, double b) {
    return std::abs(a - half) < std::abs(b - half);
  });
  std::vector<bool> inside(count);
  inside[static_cast<std::size_t>(best - branch.begin())] = true;
  for (std::size_t k = 1; k < count; ++k) {
    inside[k] = inside[k] || inside[at(tree.parent[k])];
    if (inside[k])
      part[at(tree.cells[k])] = to;
  }
}

/// \pre parts with cells are connected.
void fill_empty(const Graph& graph, const DoubleVector& weights, std::int64_t parts,
                std::vector<std::int32_t>& part) {
  const Members members = members_of(part, parts);
  std::vector<std::int32_t> empty, lowest(static_cast<std::size_t>(parts), -1);
  std::priority_queue<Divisible> heaviest;
  const std::vector<double> sums = part_weights(part, parts, weights);
  for (std::int32_t k = 0; k < parts; ++k) {
    if (members.count(k) > 0)
      lowest[at(k)] = members[k][0];
    if (members.count(k) == 0)
      empty.push_back(k);
    else if (members.count(k) > 1)
      heaviest.push({sums[at(k)], members.count(k), k});
  }
  std::vector<bool> seen(empty.empty() ? 0 : part.size());
  const auto offer = [&](std::int32_t k, const std::vector<std::int32_t>& cells) {
    Divisible of{0, 0, k};
    for (const std::int32_t cell : cells)
      if (part[at(cell)] == k) {
        if (of.cells++ == 0)
          lowest[at(k)] = cell;
        of.weight += weight_of(weights, cell);
      }
    if (of.cells > 1)
      heaviest.push(of);
  };
  for (const std::int32_t k : empty) { // there are more cells than parts with cells
    const std::int32_t from = heaviest.top().part;
    heaviest.pop();
    const Tree tree = tree_of(graph, part, lowest[at(from)], seen);
    split(tree, weights, k, part);
    offer(from, tree.cells);
    offer(k, tree.cells);
  }
}

} // namespace

std::vector<double> part_weights(const std::vector<std::int32_t>& part, std::int64_t parts,
                                 const DoubleVector& weights) {
  std::vector<double> sums(static_cast<std::size_t>(parts));
  for (std::size_t cell = 0; cell < part.size(); ++cell)
    sums[at(part[cell])] += weight_of(weights, static_cast<std::int32_t>(cell));
  return sums;
}

std::vector<std::int32_t> connected_parts(const Graph& graph, const DoubleVector& weights,
                                          std::int64_t parts, std::vector<std::int32_t> part) {
  Components components = components_of(graph, part);
  std::vector<bool> has_cells(static_cast<std::size_t>(parts));
  for (const std::int32_t cell : components.first)
    has_cells[at(part[at(cell)])] = true;
  const std::int64_t filled = std::count(has_cells.begin(), has_cells.end(), true);
  if (std::ssize(components.first) > filled)
    Fragments(graph, weights, parts, std::move(components), part).move_others();
  if (filled < parts)
    fill_empty(graph, weights, parts, part);
  return part;
}

} // namespace calotte::partition_detail
