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
struct ShoreArc {
  Arc arc;
  std::int32_t shore; ///< the closed line that it belongs to, from 0 on
};

/// Those of a coast, see shores(), each after the one before. A shore is a ring, or what is left of
/// several that are cut along each other.
///
/// \throws Error invalid_argument, naming ring and corner: one that is no direction, or opposite to
///         the one before.
std::vector<ShoreArc> shore_arcs(const Coast& coast);

/// The sides of a coast, exact.
class CoastSides {
public:
  /// \param shore not empty.
  explicit CoastSides(const std::vector<ShoreArc>& shore);

  /// \param place unit vector. Of the shore itself: neither.
  bool is_land(const Vec3& place) const { return cells_.side(place) == land_; }
  bool is_sea(const Vec3& place) const { return cells_.side(place) == sea_; }

private:
  SideCells cells_;
  Side land_ = Side::inside, sea_ = Side::outside;
};

} // namespace calotte::oceans_detail
