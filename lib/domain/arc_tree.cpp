// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/arc_tree.h"

#include "curve/hilbert.h"

#include <algorithm>
#include <utility>

namespace calotte::domain_detail {

ArcTree::ArcTree(const std::vector<Arc>& arcs) {
  std::vector<std::pair<std::uint64_t, std::int32_t>> keyed;
  keyed.reserve(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i)
    keyed.emplace_back(curve_detail::curve_key(curve_detail::to_cube(arcs[i].from + arcs[i].to)),
                       static_cast<std::int32_t>(i));
  std::sort(keyed.begin(), keyed.end());
  for (const auto& [key, arc] : keyed) {
    order_.push_back(arc);
    own_.push_back(box_of(arcs[static_cast<std::size_t>(arc)]));
  }
  while (leaves_ * arcs_of_leaf < order_.size())
    leaves_ *= 2;
  boxes_.resize(2 * leaves_);
  for (std::size_t leaf = 0; leaf < leaves_; ++leaf)
    for (std::size_t k = first_of(leaf); k < first_of(leaf + 1); ++k)
      boxes_[leaves_ + leaf] = joined(boxes_[leaves_ + leaf], own_[k]);
  for (std::size_t node = leaves_ - 1; node > 0; --node)
    boxes_[node] = joined(boxes_[2 * node], boxes_[2 * node + 1]);
}

} // namespace calotte::domain_detail
