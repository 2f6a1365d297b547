// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/lists.h"
#include "base/message.h"
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

/// Refuses rings in which arcs meet elsewhere than in the corner that joins them.
/// \throws Error invalid_argument, naming ring and corner of the first arc that meets another. Its
///         index() is the ring.
/// \return the rings.
const Rings& simple(const Rings& rings, const ArcTree& tree);

/// The arcs that meet another elsewhere than in the corner that joins them, in increasing order,
/// each with the first arc that it meets so.
std::vector<std::pair<std::int32_t, std::int32_t>> meetings(const Rings& rings,
                                                            const ArcTree& tree);

/// "ring 2, corner 5".
inline std::string corner_name(std::int64_t ring, std::int64_t corner) {
  return message("ring {}, corner {}", ring, corner);
}

/// The name of the corner at which an edge begins. \param edges lists of each ring.
template <class Edges> std::string start_name(const Edges& edges, std::int32_t edge) {
  const std::int64_t ring = list_of(edges, edge);
  return corner_name(ring, edge - edges.begin[static_cast<std::size_t>(ring)]);
}

/// The message for two edges that meet.
template <class Edges>
std::string meeting_fault(const Edges& edges, std::int32_t e, std::int32_t f) {
  return message("the edges from {} and from {} meet; rings may neither cross nor touch themselves "
                 "or each other",
                 start_name(edges, e), start_name(edges, f));
}

/// The message for a ring of one or two corners.
inline std::string few_corners_fault(const std::string& ring, std::int64_t corners) {
  return message("{} has {} and encloses nothing; give three at least", ring,
                 counted(corners, "corner"));
}

/// Refuses a region.
/// \throws Error invalid_argument, always.
[[noreturn]] void refuse_region(const std::string& what, std::int64_t ring = -1);

} // namespace calotte::domain_detail
