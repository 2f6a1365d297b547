// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "curve/room.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace calotte::curve_detail {

/// A box of space, closed.
struct Box3 {
  Vec3 low = corner(std::numeric_limits<double>::infinity()),
       high = corner(-std::numeric_limits<double>::infinity()); ///< default: empty

  static constexpr Vec3 corner(double x) { return {x, x, x}; }
};

inline Box3 joined(const Box3& a, const Box3& b) {
  return {
      {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
      {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

inline bool overlap(const Box3& a, const Box3& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// The square of the distance from a point to a box; 0 inside it.
inline double square_from(const Box3& box, const Vec3& p) {
  const Vec3 beyond{std::max({0.0, box.low.x - p.x, p.x - box.high.x}),
                    std::max({0.0, box.low.y - p.y, p.y - box.high.y}),
                    std::max({0.0, box.low.z - p.z, p.z - box.high.z})};
  return dot(beyond, beyond);
}

/// Items sorted along the space-filling curve, below a binary tree of their bounds: node k has the
/// children 2k and 2k + 1.
/// \tparam Bounds bounds of an item, or of all items below a node. By default they are empty;
///         joined(a, b) are those of the items of a and of b.
template <class Bounds> class BoundsTree {
public:
  BoundsTree() = default;

  /// \param bounds of the items.
  /// \param keys of the items along the curve, see hilbert.h.
  BoundsTree(const std::vector<Bounds>& bounds, const std::vector<std::uint64_t>& keys)
      : order_(bounds.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
      return std::pair(keys[static_cast<std::size_t>(a)], a) <
             std::pair(keys[static_cast<std::size_t>(b)], b);
    });
    for (const std::int32_t item : order_)
      own_.push_back(bounds[static_cast<std::size_t>(item)]);
    while (leaves_ * items_of_leaf < order_.size())
      leaves_ *= 2;
    nodes_.resize(2 * leaves_);
    for (std::size_t leaf = 0; leaf < leaves_; ++leaf)
      for (std::size_t k = first_of(leaf); k < first_of(leaf + 1); ++k)
        nodes_[leaves_ + leaf] = joined(nodes_[leaves_ + leaf], own_[k]);
    for (std::size_t node = leaves_ - 1; node > 0; --node)
      nodes_[node] = joined(nodes_[2 * node], nodes_[2 * node + 1]);
  }

  /// Calls body(item) once for each item whose bounds satisfy meets(bounds). The order of the calls
  /// is a function of the items alone.
  /// \param meets must be true for the bounds of a node if it is true for those of an item below.
  template <class Meets, class Body> void visit(const Meets& meets, const Body& body) const {
    if (order_.empty())
      return;
    std::size_t waiting[64]; // a node for each level, and its sibling
    std::size_t count = 0;
    waiting[count++] = 1;
    while (count > 0) {
      const std::size_t node = waiting[--count];
      if (!meets(nodes_[node]))
        continue;
      if (node < leaves_) {
        waiting[count++] = 2 * node + 1;
        waiting[count++] = 2 * node;
        continue;
      }
      for (std::size_t k = first_of(node - leaves_); k < first_of(node - leaves_ + 1); ++k)
        if (meets(own_[k]))
          body(order_[k]);
    }
  }

  /// Calls body(item) for the items for which distance(bounds) is less than a limit, roughly from
  /// the nearest on. A body that lowers the limit to what it finds soon leaves little to visit.
  /// \param distance must be no larger for the bounds of a node than for those of an item below.
  template <class Distance, class Body>
  void visit_nearest(const Distance& distance, const double& limit, const Body& body) const {
    if (order_.empty())
      return;
    struct {
      std::size_t node;
      double distance;
    } waiting[64]; // a node for each level, and its sibling
    std::size_t count = 0;
    waiting[count++] = {1, distance(nodes_[1])};
    while (count > 0) {
      const auto [node, away] = waiting[--count];
      if (!(away < limit))
        continue;
      if (node < leaves_) {
        const double first = distance(nodes_[2 * node]), second = distance(nodes_[2 * node + 1]);
        const bool first_is_nearer = first <= second;
        waiting[count++] = {2 * node + (first_is_nearer ? 1 : 0), std::max(first, second)};
        waiting[count++] = {2 * node + (first_is_nearer ? 0 : 1), std::min(first, second)};
        continue;
      }
      for (std::size_t k = first_of(node - leaves_); k < first_of(node - leaves_ + 1); ++k)
        if (distance(own_[k]) < limit)
          body(order_[k]);
    }
  }

private:
  static constexpr std::size_t items_of_leaf = 4;

  std::size_t first_of(std::size_t leaf) const { return leaf * order_.size() / leaves_; }

  std::vector<std::int32_t> order_; ///< items along the curve
  std::vector<Bounds> own_;         ///< of the items, in this order
  std::vector<Bounds> nodes_;       ///< of the nodes
  std::size_t leaves_ = 1;
};

using BoxTree = BoundsTree<Box3>;

} // namespace calotte::curve_detail
