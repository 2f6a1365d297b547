// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "base/vec3.h"
#include "delaunay/room.h"

#include <array>
#include <cstdint>
#include <vector>

namespace calotte::delaunay_detail {

/// An axis-parallel box: middle and half extents, rounded up.
struct SiteBox {
  std::array<float, 3> middle, half;
};

/// A tree of boxes over sites sorted along a space-filling curve: leaves of 8 consecutive sites,
/// eight nodes to each node above (a packed Hilbert R-tree: Kamel and Faloutsos, 1993). It fits any
/// distribution of the sites; a quadtree does not fit sites that crowd along a line.
class SiteBoxes {
public:
  static constexpr std::int64_t width = 8;

  SiteBoxes() = default;
  explicit SiteBoxes(const Array<Vec3>& sites);

  /// Levels of nodes; level 0 is that of the leaves, the highest has `width` nodes at most.
  int levels() const { return static_cast<int>(levels_.size()); }
  std::int64_t nodes(int level) const { return levels_[static_cast<std::size_t>(level)].size(); }
  /// The box of the nodes i * width to (i + 1) * width - 1 of the level below; at level 0, of these
  /// sites.
  const SiteBox& box(int level, std::int64_t i) const {
    return levels_[static_cast<std::size_t>(level)][i];
  }

private:
  std::vector<Array<SiteBox>> levels_;
};

} // namespace calotte::delaunay_detail
