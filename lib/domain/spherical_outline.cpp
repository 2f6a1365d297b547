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
      area_(area_inside(cells_)) {
  for (std::size_t r = 1; r < static_cast<std::size_t>(rings.arcs.size()); ++r)
    if (!cells_.inside_is_left(rings.corner_of(r)))
      refuse_region(message("it is to the left of ring 0 and to the right of ring {}; give rings "
                            "that all have it to their left: an outer boundary "
                            "counter-clockwise, a hole clockwise",
                            r),
                    static_cast<std::int64_t>(r));
}

} // namespace calotte::domain_detail
