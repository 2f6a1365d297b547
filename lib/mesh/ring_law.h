// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "mesh/stars.h"

#include <cstdint>
#include <string>

/// The law of the triangles around a site.
namespace calotte::mesh_detail {

/// The triangles around a site are one cycle that turns around it once, or one fan of at most half
/// a turn.
///
/// Seen from the sphere's centre, the sites across turn left by less than half a turn from one to
/// the next, as all triangles are counter-clockwise. With the first of them ahead, each is in the
/// left half plane or in the right one; the walk has turned around once each time it comes from the
/// right to the left. A fan of at most half a turn has all on the left, the last perhaps behind:
/// the boundary is convex there.
/// \param convex whether the boundary must be convex. Otherwise a fan may have up to a whole turn,
///        and at a site where the boundary passes more than once, one of the fans is examined.
template <class Surface>
std::string ring_failure(const Surface& s, const Stars& stars, std::int32_t site,
                         bool convex = true) {
  const Corner first = stars.first(site);
  if (!exists(first))
    return message("site {} is not a vertex of any triangle", site);
  const std::int32_t ahead = following_site(s, first);
  std::int32_t walked = 0, turns = 0;
  int way = 1;
  bool reflex = false;
  int side = 1; // of the site across last reached: 1 ahead or left, -1 behind or right
  const Corner last = walk_around(s, first, [&](Corner corner) {
    const std::int32_t across = preceding_site(s, corner);
    way = across == ahead ? 1 : s.orientation(site, ahead, across);
    const int new_side = way > 0 ? 1 : -1;
    turns += side < 0 && new_side > 0;
    reflex = reflex || side < 0;
    side = new_side;
    ++walked;
  });
  const bool is_fan = exists(last);
  if (is_fan && convex && (reflex || way < 0))
    return message("the boundary is not convex at site {}", site);
  if (walked < stars.size(site) && (convex || !is_fan))
    return message("the triangles at site {} are not a single cycle or fan", site);
  if (is_fan && turns > 0)
    return message("the triangles at site {} overlap", site);
  if (!is_fan && turns != 1)
    return message("the triangles turn {} times around site {}", turns, site);
  return {};
}

} // namespace calotte::mesh_detail
