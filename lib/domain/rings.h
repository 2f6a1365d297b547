// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/lists.h"
#include "domain/arc_tree.h"
#include "domain/arcs.h"
#include "domain/room.h"
#include "domain/side_cells.h"

#include <calotte/mesh.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace calotte::domain_detail {

/// Closed rings of arcs on the sphere, one after the other.
struct Rings {
  Lists<std::vector<Arc>, std::vector<std::int32_t>> arcs{{0}, {}};

  const Arc& arc(std::int32_t i) const { return arcs.items[static_cast<std::size_t>(i)]; }

  /// "ring 2, corner 5": where an arc begins.
  std::string name_of(std::int32_t arc) const;

  /// The first corner of a ring.
  SideCells::Corner corner_of(std::size_t ring) const {
    return {arcs.begin[ring + 1] - 1, arcs.begin[ring]};
  }
};

/// \throws Error invalid_argument, naming ring and corner, for a corner that is no direction.
void require_directions(const Points3& corners, std::int64_t ring);

/// The rings of corners, 3 x n directions each, rounded to unit vectors.
/// \throws Error invalid_argument, naming ring and corner: fewer than three corners; a corner that
///         is no direction; equal or opposite neighbours. Its index() is the ring.
Rings rings_of(const Surface::Rings& corners);

/// The first arc that meets another elsewhere than in the corner that joins them; -1 for none.
std::int64_t first_meeting(const Rings& rings, const ArcTree& tree);

/// Throws where arcs meet elsewhere than in the corner that joins them.
/// \throws Error invalid_argument, naming ring and corner of the first arc that meets another. Its
///         index() is the ring.
/// \return the rings.
const Rings& simple(const Rings& rings, const ArcTree& tree);

/// The arcs that meet another elsewhere than in the corner that joins them, in increasing order,
/// each with the first arc that it meets so.
std::vector<std::pair<std::int32_t, std::int32_t>> meetings(const Rings& rings,
                                                            const ArcTree& tree);

/// Ends in an error on a region.
/// \throws Error invalid_argument, always.
[[noreturn]] void refuse_region(const std::string& what, std::int64_t ring = -1);

} // namespace calotte::domain_detail
