// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/arc_tree.h"

#include "curve/hilbert.h"

#include <cstdint>

namespace calotte::domain_detail {
namespace {

BoxTree tree_of(const std::vector<Arc>& arcs) {
  std::vector<Box3> boxes;
  std::vector<std::uint64_t> keys;
  for (const Arc& arc : arcs) {
    boxes.push_back(box_of(arc));
    keys.push_back(curve_key(to_cube(arc.from + arc.to)));
  }
  return {boxes, keys};
}

} // namespace

ArcTree::ArcTree(const std::vector<Arc>& arcs) : BoxTree(tree_of(arcs)) {}

} // namespace calotte::domain_detail
