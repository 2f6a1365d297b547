// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/arcs.h"
#include "domain/room.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace calotte::domain_detail {

/// Arcs sorted along a space-filling curve, below a binary tree of boxes: node k has the children
/// 2k and 2k + 1.
class ArcTree {
public:
  explicit ArcTree(const std::vector<Arc>& arcs);

  /// Calls body(index of the arc) once for each arc whose box satisfies meets(box). The order of
  /// the calls is a function of the arcs alone.
  /// \param meets true for a box that contains one for which it is true.
  template <class Meets, class Body> void visit(const Meets& meets, const Body& body) const {
    std::size_t waiting[64]; // a node for each level, and its sibling
    std::size_t count = 0;
    waiting[count++] = 1;
    while (count > 0) {
      const std::size_t node = waiting[--count];
      if (!meets(boxes_[node]))
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

private:
  static constexpr std::size_t arcs_of_leaf = 4;

  std::size_t first_of(std::size_t leaf) const { return leaf * order_.size() / leaves_; }

  std::vector<std::int32_t> order_; ///< indices of arcs along the curve
  std::vector<Box3> own_;           ///< of the arcs, in this order
  std::vector<Box3> boxes_;         ///< of the nodes
  std::size_t leaves_ = 1;
};

} // namespace calotte::domain_detail
