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

double cell_weight(const DoubleVector& weights, std::int32_t cell) {
  return weights.size() == 0 ? 1 : weights[cell];
}

Members group_cells(const std::vector<std::int32_t>& group, std::int64_t groups) {
  return lists_by_key<std::vector<std::int32_t>>(groups, [&](const auto& put) {
    for (std::size_t cell = 0; cell < group.size(); ++cell)
      put(group[cell], static_cast<std::int32_t>(cell));
  });
}

// ---- Components of parts

/// The components of parts. Each part keeps the heaviest of its components.
class Fragments {
public:
  Fragments(const Graph& graph, const DoubleVector& weights, std::int64_t parts,
            Components components, std::vector<std::int32_t>& part)
      : graph_(graph), part_(part), parts_(std::move(components)),
        cells_(group_cells(parts_.of, std::ssize(parts_.first))), weights_(parts_.first.size()),
        kept_(parts_.first.size()), of_part_(part_weights(part, parts, weights)),
        limit_((1 + aimed_imbalance) * std::accumulate(of_part_.begin(), of_part_.end(), 0.0) /
               static_cast<double>(parts)) {
    for (std::size_t k = 0; k < weights_.size(); ++k)
      for (const std::int32_t cell : cells_[static_cast<std::int64_t>(k)])
        weights_[k] += cell_weight(weights, cell);
    keep_heaviest(parts);
  }

  /// Moves all other components. The graph is connected, so that one of them has a neighbour that
  /// stays.
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

  /// Compares components by weight, then by number of cells, since weights may be 0.
  bool is_heavier(std::size_t a, std::size_t b) const {
    return std::pair(weights_[a], count(a)) > std::pair(weights_[b], count(b));
  }

  std::int64_t count(std::size_t k) const { return cells_.count(static_cast<std::int64_t>(k)); }

  /// Moves a component to a neighbouring part. Returns false if it has no neighbour that stays.
  bool move(std::size_t k) {
    std::unordered_map<std::int32_t, std::int64_t> edges; // number of edges by part
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

  /// The rank of a part as a target for a component: within the limit, then most edges, then the
  /// lightest, then the lowest.
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
  std::vector<double> of_part_; ///< weight of each part
  double limit_;                ///< upper limit of the weight of a part
};

// ---- Parts without cells

/// A part of several cells, which can be split. The heaviest compares greatest.
struct Divisible {
  double weight;
  std::int64_t cells;
  std::int32_t part;

  bool operator<(const Divisible& other) const {
    return std::tuple(weight, cells, -part) < std::tuple(other.weight, other.cells, -other.part);
  }
};

/// A spanning tree of a connected part from its lowest cell: each cell comes after its parent.
/// `parent` contains indices.
struct Tree {
  std::vector<std::int32_t> cells, parent;
};

Tree make_tree(const Graph& graph, const std::vector<std::int32_t>& part, std::int32_t root,
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

/// Gives to another part the branch of a tree whose weight is nearest to half of the total. The
/// branch and the rest are connected. \pre the tree has several cells
void split(const Tree& tree, const DoubleVector& weights, std::int32_t to,
           std::vector<std::int32_t>& part) {
  const std::size_t count = tree.cells.size();
  std::vector<double> branch(count); // a small term for each cell splits cells of weight 0, too
  double whole = 0;
  for (const std::int32_t cell : tree.cells)
    whole += cell_weight(weights, cell);
  const double share = whole > 0 ? 1e-9 * whole / static_cast<double>(count) : 1;
  for (std::size_t k = count; k-- > 0;) {
    branch[k] += cell_weight(weights, tree.cells[k]) + share;
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
  const Members members = group_cells(part, parts);
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
        of.weight += cell_weight(weights, cell);
      }
    if (of.cells > 1)
      heaviest.push(of);
  };
  for (const std::int32_t k : empty) { // there are more cells than parts with cells
    const std::int32_t from = heaviest.top().part;
    heaviest.pop();
    const Tree tree = make_tree(graph, part, lowest[at(from)], seen);
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
    sums[at(part[cell])] += cell_weight(weights, static_cast<std::int32_t>(cell));
  return sums;
}

std::vector<std::int32_t> connected_parts(const Graph& graph, const DoubleVector& weights,
                                          std::int64_t parts, std::vector<std::int32_t> part) {
  Components components = find_components(graph, part);
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
