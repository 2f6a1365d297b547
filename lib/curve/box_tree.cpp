// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/box_tree.h"

#include <numeric>
#include <utility>

namespace calotte::curve_detail {

BoxTree::BoxTree(const std::vector<Box3>& boxes, const std::vector<std::uint64_t>& keys)
    : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
    return std::pair(keys[static_cast<std::size_t>(a)], a) <
           std::pair(keys[static_cast<std::size_t>(b)], b);
  });
  for (const std::int32_t item : order_)
    own_.push_back(boxes[static_cast<std::size_t>(item)]);
  while (leaves_ * items_of_leaf < order_.size())
    leaves_ *= 2;
  boxes_.resize(2 * leaves_);
  for (std::size_t leaf = 0; leaf < leaves_; ++leaf)
    for (std::size_t k = first_of(leaf); k < first_of(leaf + 1); ++k)
      boxes_[leaves_ + leaf] = joined(boxes_[leaves_ + leaf], own_[k]);
  for (std::size_t node = leaves_ - 1; node > 0; --node)
    boxes_[node] = joined(boxes_[2 * node], boxes_[2 * node + 1]);
}

} // namespace calotte::curve_detail
