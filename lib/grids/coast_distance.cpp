// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "density/width_profile.h"
#include "density/width_rules.h"
#include "grids/shores.h"

#include <calotte/widths.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace calotte {
namespace {

/// A profile of distances on one side, with nothing on the other.
WidthProfile one_sided(WidthProfile profile, CoastSide side) {
  constexpr double edge = 1e-6; // km
  const density_detail::ProfileCurve given(profile, "a distance", 0,
                                           density_detail::farthest_on_sphere); // refuses bad nodes
  auto& nodes = profile.nodes;
  if (const auto [distance, width] = nodes.front(); distance > 0)
    nodes.insert(nodes.begin(), {0, width});
  nodes.insert(nodes.begin(), {-edge, Widths::no_demand});
  if (side == CoastSide::land) {
    std::reverse(nodes.begin(), nodes.end());
    for (auto& [distance, width] : nodes)
      distance = -distance;
  }
  return profile;
}

} // namespace

Widths Widths::by_coast(const Coast& coast, const WidthProfile& profile, CoastSide side) {
  using namespace grids_detail;
  const WidthProfile both = side == CoastSide::both ? profile : one_sided(profile, side);
  const std::vector<ShoreArc> shore = shore_arcs(coast);
  base_detail::require(!shore.empty(), "the coast has no shore to be distant from; give rings");
  const auto sides = std::make_shared<const CoastSides>(shore);
  return Widths(density_detail::rule_of_sides(
      shores(coast), [sides](const Vec3& place) { return sides->is_land(place); }, both));
}

} // namespace calotte
