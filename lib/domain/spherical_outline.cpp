// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/spherical_outline.h"

#include "base/message.h"
#include "domain/rings.h"
#include "domain/spherical_area.h"

#include <utility>

namespace calotte::domain_detail {

SphericalOutline::SphericalOutline(const Surface::Rings& rings)
    : SphericalOutline(rings_of(rings)) {}

SphericalOutline::SphericalOutline(const Rings& rings)
    : tree_(rings.arcs.items), cells_(simple(rings, tree_).arcs.items, rings.corner_of(0)),
      ring_begin_(rings.arcs.begin), area_(area_inside(cells_)) {
  for (std::size_t r = 1; r < static_cast<std::size_t>(rings.arcs.size()); ++r)
    if (!cells_.inside_is_left(rings.corner_of(r)))
      refuse_region(message("it is to the left of ring 0 and to the right of ring {}; give rings "
                            "that all have it to their left: an outer boundary "
                            "counter-clockwise, a hole clockwise",
                            r),
                    static_cast<std::int64_t>(r));
}

std::vector<std::vector<Vec3>> SphericalOutline::rings() const {
  std::vector<std::vector<Vec3>> rings;
  for (std::size_t r = 0; r + 1 < ring_begin_.size(); ++r) {
    std::vector<Vec3>& corners = rings.emplace_back();
    for (std::int32_t e = ring_begin_[r]; e < ring_begin_[r + 1]; ++e)
      corners.push_back(edges()[static_cast<std::size_t>(e)].from);
  }
  return rings;
}

} // namespace calotte::domain_detail
