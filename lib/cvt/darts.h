// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "curve/box_tree.h"
#include "cvt/room.h"

#include <calotte/density.h>
#include <calotte/matrices.h>
#include <calotte/surface.h>

#include <cstdint>
#include <vector>

namespace calotte::cvt_detail {

/// Candidates for generators, in the order in which they are drawn.
struct Candidates {
  Points3 points;
  DoubleVector width;              ///< the distance of neighbours that is demanded there
  std::vector<std::uint64_t> keys; ///< neighbours along a curve have similar ones
};

/// Selects candidates in the order of the draw, each at some share of the demanded distance from
/// other generators and from those before it. The share falls until there are enough (relaxed dart
/// throwing; McCool and Fiume, Graphics Interface, 1992). All gaps between other generators,
/// however narrow, get their part of the points. A descent moves none from sea to sea through a
/// strait.
class Darts {
public:
  /// \param candidates must outlive this.
  Darts(const Candidates& candidates, const Surface& surface);

  /// Adds a generator that stands already. \param width the distance demanded there.
  void put(const Vec3& point, double width) { others_.push_back({point, width}); }

  /// Returns the indices of the selected candidates, in the order of selection: `count`, or all.
  std::vector<std::int64_t> take(std::int64_t count) const;

private:
  struct Other {
    Vec3 at;
    double width;
  };

  void approach(const Other& one, double share, std::vector<double>& square) const;

  const Candidates& in_;
  Eigen::Vector2d period_; ///< of the surface, 0 where it has none
  BoxTree tree_;
  std::vector<Other> others_;
};

} // namespace calotte::cvt_detail
