// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/owners.h"

#include "base/parallel.h"

#include <algorithm>
#include <limits>
#include <span>

namespace calotte::delaunay_detail {
namespace {

std::int32_t nearest(const Vec3& x, const std::vector<Vec3>& centres,
                     std::span<const std::int32_t> candidates) {
  std::int32_t best = candidates.front();
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t k : candidates) { // ascending, so that a tie stays with the lowest
    const Vec3 apart = x - centres[static_cast<std::size_t>(k)];
    if (const double square = dot(apart, apart); square < least) {
      best = k;
      least = square;
    }
  }
  return best;
}

/// Descends the quadtree together with the centres that may be nearest to some site of a cell. The
/// candidates are kept on a stack, those of a cell above those of its parent: allocating in every
/// cell would make threads wait for each other.
class OwnerDescent {
public:
  OwnerDescent(const Quadtree& tree, const Vec3* unit, const std::vector<Vec3>& centres,
               std::int32_t* owner)
      : tree_(tree), unit_(unit), centres_(centres), owner_(owner), candidates_(all_of(centres)) {}

  void run(const QuadtreeCell& cell) { own(cell, 0); }

private:
  /// Finds the owners of a cell's sites. The candidates are those from index `first` on.
  void own(const QuadtreeCell& cell, std::size_t first) {
    const std::size_t end = candidates_.size();
    push_possible(bounding_ball(cell), first);
    const std::span possible = std::span(candidates_).subspan(end);
    if (possible.size() == 1) {
      std::fill(owner_ + cell.begin, owner_ + cell.end, possible.front());
    } else if (cell.size() <= leaf_size || !cell.divisible()) {
      for (std::int64_t r = cell.begin; r != cell.end; ++r)
        owner_[r] = nearest(unit_[r], centres_, possible);
    } else {
      for (const QuadtreeCell& child : tree_.children(cell))
        if (child.size() > 0)
          own(child, end);
    }
    candidates_.resize(end);
  }

  /// Pushes those candidates that may be nearest to a direction in the ball.
  void push_possible(const Ball& ball, std::size_t first) {
    const std::size_t end = candidates_.size();
    distance_.clear();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = first; c != end; ++c) {
      distance_.push_back(norm(ball.centre - centres_[static_cast<std::size_t>(candidates_[c])]));
      least = std::min(least, distance_.back());
    }
    for (std::size_t c = first; c != end; ++c)
      if (distance_[c - first] <= least + 2 * ball.radius + 1e-14)
        candidates_.push_back(candidates_[c]);
  }

  const Quadtree& tree_;
  const Vec3* unit_;
  const std::vector<Vec3>& centres_;
  std::int32_t* owner_;
  std::vector<std::int32_t> candidates_;
  std::vector<double> distance_; ///< by candidate of one cell
};

} // namespace

std::vector<QuadtreeCell> task_cells(const Quadtree& tree) {
  constexpr std::int64_t parts = 128, least = 256; // a task of fewer sites is not worth a thread
  const std::int64_t enough = std::max(tree.size() / parts, least);
  std::vector<QuadtreeCell> cells, pending;
  const auto push_reversed = [&](const auto& group) {
    for (auto it = group.rbegin(); it != group.rend(); ++it)
      if (it->size() > 0)
        pending.push_back(*it);
  };
  push_reversed(tree.faces());
  while (!pending.empty()) {
    const QuadtreeCell cell = pending.back();
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

Array<std::int32_t> owners(const Quadtree& tree, const Array<Vec3>& unit,
                           const std::vector<Vec3>& centres) {
  Array<std::int32_t> owner(unit.size());
  const std::vector<QuadtreeCell> cells = task_cells(tree);
  for_each_task(std::ssize(cells), [&](std::int64_t c) {
    OwnerDescent(tree, unit.begin(), centres, owner.begin())
        .run(cells[static_cast<std::size_t>(c)]);
  });
  return owner;
}

} // namespace calotte::delaunay_detail
