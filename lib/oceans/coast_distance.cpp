// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "base/vec3.h"
#include "density/width_profile.h"
#include "density/width_rules.h"
#include "oceans/coast_sides.h"

#include <calotte/widths.h>

#include <functional>
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

/// Whether distances from a coast are negative at a point: on land, or with `from_land` elsewhere.
std::function<bool(const base_detail::Vec3&)> behind_coast(const Coast& coast, bool from_land) {
  using namespace oceans_detail;
  const std::vector<CoastArc> arcs = coast_arcs(coast);
  base_detail::require(!arcs.empty(), "the coast has no shore to be distant from; give rings");
  return [sides = std::make_shared<const CoastSides>(arcs), from_land](const Vec3& point) {
    return sides->is_land(point) != from_land;
  };
}

} // namespace

Widths Widths::by_distance(const Coast& coast, const WidthProfile& profile, CoastSide side) {
  const density_detail::ProfileCurve curve = curve_of(profile, side);
  return Widths(density_detail::rule_of_sides(shores(coast),
                                              behind_coast(coast, side == CoastSide::land), curve));
}

WidthShare::WidthShare(const Coast& coast, const WidthProfile& profile) {
  constexpr double farthest = density_detail::farthest_on_sphere;
  const density_detail::ProfileCurve curve(profile, "a distance", -farthest, farthest, "share",
                                           density_detail::a_fraction);
  rule_of_radius_ =
      density_detail::share_of_sides(shores(coast), behind_coast(coast, false), curve);
}

} // namespace calotte
