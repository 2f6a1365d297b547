// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/room.h"

#include <calotte/surface.h>

#include <utility>
#include <vector>

namespace calotte {

/// A bounded domain of the plane: the interior of closed polygons, or a doubly periodic box.
struct PlanarDomain {
  /// Boundary polygons, each 2 x corners in either orientation, in any unit of length; an edge
  /// joins the last corner to the first. A point is inside the domain if it lies inside an odd
  /// number of rings, so that rings can be outer boundaries, holes and islands. Default: none, a
  /// periodic box.
  std::vector<DoubleMatrix> rings;
  /// Side lengths of the box [0, period.x) x [0, period.y); from 1e-30 to 1e30 without rings, else
  /// 0.
  Eigen::Vector2d period{0, 0};

  PlanarDomain() = default; ///< neither rings nor a box
  /// The members.
  PlanarDomain(std::vector<DoubleMatrix> all, const Eigen::Vector2d& box = {0, 0})
      : rings(std::move(all)), period(box) {}
  PlanarDomain(const Surface& surface); ///< \throws Error invalid_argument for the sphere
  operator Surface() const;             ///< not checked

  /// True for a periodic box.
  bool periodic() const { return rings.empty(); }
};

/// Throws unless the rings bound a well-defined region, or the period is valid. Absolute
/// coordinates are at most 1e30; the domain's extent is at least 1e-30.
/// \throws Error invalid_argument, naming ring and corner: no ring and no period; a ring that has
///         not 2 rows; fewer than three corners; a coordinate that is not finite; an edge without
///         length; edges that meet elsewhere than in the corner that joins them.
void require_domain(const PlanarDomain& domain);

} // namespace calotte
