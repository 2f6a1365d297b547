// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/line_distance.h"
#include "oceans/room.h"

#include <calotte/surface.h>

#include <vector>

namespace calotte::oceans_detail {

using density_detail::LineDistance;

/// A closed ring of points that are near each other. Lengths are radians.
struct FineRing {
  std::vector<Vec3> points;
  std::vector<double> widths;  ///< of a grid, by point
  std::vector<double> reaches; ///< how far a point may move
};

/// Rings at the widths of a grid: with corners among the points of fine rings, about a width apart,
/// and where a ring bends half a width. A corner stands on the coast, at its nearest point, where
/// that is within reach. Corners leave the coast beside land narrower than a third of a width. They
/// leave it, and then others are added, where arcs meet. \param rings that do not meet, each of
/// three points or more.
Surface::Rings fitted_rings(const std::vector<FineRing>& rings, const LineDistance& coast);

} // namespace calotte::oceans_detail
