// SPDX-License-Identifier: GPL-3.0-or-later
#include "owners.h"

#include "parallel.h"

#include <algorithm>
#include <limits>

namespace calotte::detail {
namespace {

std::int32_t nearest(const Vec3& x, const std::vector<Vec3>& centres,
                     const std::vector<std::int32_t>& candidates) {
  std::int32_t best = candidates.front();
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t k : candidates) { // ascending: a tie stays with the lowest
    const Vec3 apart = x - centres[static_cast<std::size_t>(k)];
    if (const double square = dot(apart, apart); square < least) {
      best = k;
      least = square;
    }
  }
  return best;
}

/// Those candidates that may be nearest to a direction in the ball.
std::vector<std::int32_t> possible_owners(const Ball& ball, const std::vector<Vec3>& centres,
                                          const std::vector<std::int32_t>& candidates) {
  std::vector<double> distance(candidates.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    distance[c] = norm(ball.centre - centres[static_cast<std::size_t>(candidates[c])]);
    least = std::min(least, distance[c]);
  }
  std::vector<std::int32_t> possible;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    if (distance[c] <= least + 2 * ball.radius + 1e-14)
      possible.push_back(candidates[c]);
  return possible;
}

void own(const Cell& cell, const CellTree& tree, const Vec3* unit, const std::vector<Vec3>& centres,
         const std::vector<std::int32_t>& candidates, std::int32_t* owner) {
  const std::vector<std::int32_t> possible =
      possible_owners(bounding_ball(cell), centres, candidates);
  if (possible.size() == 1) {
    std::fill(owner + cell.begin, owner + cell.end, possible.front());
  } else if (cell.size() <= leaf_size || !cell.divisible()) {
    for (std::int64_t r = cell.begin; r != cell.end; ++r)
      owner[r] = nearest(unit[r], centres, possible);
  } else {
    for (const Cell& child : tree.children(cell))
      if (child.size() > 0)
        own(child, tree, unit, centres, possible, owner);
  }
}

} // namespace

std::vector<Cell> task_cells(const CellTree& tree) {
  const std::int64_t enough = tree.size() / 128 + leaf_size;
  std::vector<Cell> cells, pending;
  const auto push_reversed = [&](const auto& group) {
    for (auto it = group.rbegin(); it != group.rend(); ++it)
      if (it->size() > 0)
        pending.push_back(*it);
  };
  push_reversed(tree.faces());
  while (!pending.empty()) {
    const Cell cell = pending.back();
    pending.pop_back();
    if (cell.size() <= enough || !cell.divisible())
      cells.push_back(cell);
    else
      push_reversed(tree.children(cell));
  }
  return cells;
}

std::vector<std::int32_t> all_of(const std::vector<Vec3>& centres) {
  std::vector<std::int32_t> all(centres.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    all[k] = static_cast<std::int32_t>(k);
  return all;
}

Array<std::int32_t> owners(const CellTree& tree, const Array<Vec3>& unit,
                           const std::vector<Vec3>& centres) {
  Array<std::int32_t> owner(unit.size());
  const std::vector<Cell> cells = task_cells(tree);
  const std::vector<std::int32_t> all = all_of(centres);
  for_each_task(std::ssize(cells), [&](std::int64_t c) {
    own(cells[static_cast<std::size_t>(c)], tree, unit.begin(), centres, all, owner.begin());
  });
  return owner;
}

} // namespace calotte::detail
