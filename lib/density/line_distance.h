// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/room.h"
#include "domain/arc_tree.h"
#include "domain/arcs.h"

#include <calotte/types.h>

#include <span>
#include <vector>

namespace calotte::density_detail {

/// Distances on the unit sphere from the nearest of many arcs and points.
class LineDistance {
public:
  /// \param lines see Widths::by_distance(). \throws Error as there.
  explicit LineDistance(const std::vector<Points3>& lines);

  /// Radians, at unit vectors. Where each lies next to the one before, it takes less time.
  void operator()(std::span<const Vec3> places, std::span<double> angles) const;

private:
  double square_from(std::int32_t item, const Vec3& p) const;

  std::vector<Arc> arcs_; ///< of a point both ends are the same
  ArcTree tree_;
};

} // namespace calotte::density_detail
