// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/arcs.h"
#include "domain/side_cells.h"
#include "oceans/room.h"

#include <calotte/ocean.h>

#include <cstdint>
#include <vector>

namespace calotte::oceans_detail {

using domain_detail::Side, domain_detail::SideCells;

/// An arc of a coast between land, to its left, and the sea.
struct CoastArc {
  Arc arc;
  std::int32_t line; ///< the closed line that it belongs to, from 0 on
};

/// The arcs of a coast as they follow each other, line by line, see shores(). A line is a ring, or
/// what is left of several rings that are cut along each other: each arc that runs back cancels
/// one. All lines are closed, also of simplified coasts, which pass some arcs more than once.
///
/// \throws Error invalid_argument, naming ring and corner: one that is no direction, or opposite to
///         the one before.
std::vector<CoastArc> coast_arcs(const Coast& coast);

/// The sides of a coast, exact.
class CoastSides {
public:
  /// \param arcs of the whole coast; not empty.
  explicit CoastSides(const std::vector<CoastArc>& arcs);

  /// \param point unit vector. A point on the coast is neither.
  bool is_land(const Vec3& point) const { return cells_.side(point) == land_; }
  bool is_sea(const Vec3& point) const { return cells_.side(point) == sea_; }

private:
  SideCells cells_;
  Side land_ = Side::inside, sea_ = Side::outside;
};

} // namespace calotte::oceans_detail
