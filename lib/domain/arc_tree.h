// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "curve/box_tree.h"
#include "domain/arcs.h"
#include "domain/room.h"

#include <vector>

namespace calotte::domain_detail {

/// A tree over arcs, whose items are their indices.
class ArcTree : public BoxTree {
public:
  explicit ArcTree(const std::vector<Arc>& arcs);
};

} // namespace calotte::domain_detail
