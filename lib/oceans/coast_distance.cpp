// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "density/width_profile.h"
#include "density/width_rules.h"
#include "oceans/coast_sides.h"

#include <calotte/widths.h>

#include <limits>
#include <memory>
#include <vector>

namespace calotte {
namespace {

/// The curve of a profile over distances that are positive in the sea and negative on land, or on
/// one side only.
density_detail::ProfileCurve curve_of(const WidthProfile& profile, CoastSide side) {
  constexpr double farthest = density_detail::farthest_on_sphere;
  const bool both = side == CoastSide::both;
  const density_detail::ProfileCurve curve(profile, "a distance", both ? -farthest : 0, farthest);
  constexpr double rounding = 1e-6; // km: the coast itself belongs to both sides
  return both ? curve : curve.within(-rounding, std::numeric_limits<double>::infinity());
}

} // namespace

Widths Widths::by_distance(const Coast& coast, const WidthProfile& profile, CoastSide side) {
  using namespace oceans_detail;
  const density_detail::ProfileCurve curve = curve_of(profile, side);
  const std::vector<CoastArc> arcs = coast_arcs(coast);
  base_detail::require(!arcs.empty(), "the coast has no shore to be distant from; give rings");
  const auto sides = std::make_shared<const CoastSides>(arcs);
  const bool on_land = side == CoastSide::land;
  const auto is_behind = [sides, on_land](const Vec3& point) {
    return sides->is_land(point) != on_land;
  };
  return Widths(density_detail::rule_of_sides(shores(coast), is_behind, curve));
}

} // namespace calotte
