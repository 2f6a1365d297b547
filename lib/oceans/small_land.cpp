// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/ocean.h>

#include "base/require.h"
#include "domain/spherical_area.h"
#include "oceans/coast_sides.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace oceans_detail;

/// The corners of a closed line, in its order.
Points3 ring_of(const std::vector<Arc>& line) {
  Points3 ring(3, std::ssize(line));
  for (std::size_t k = 0; k < line.size(); ++k)
    set_column(ring, static_cast<Eigen::Index>(k), line[k].from);
  return ring;
}

/// The closed lines of a coast.
std::vector<std::vector<Arc>> lines_of(const Coast& coast) {
  std::vector<std::vector<Arc>> lines;
  for (const CoastArc& each : coast_arcs(coast)) {
    if (each.line == std::ssize(lines))
      lines.emplace_back();
    lines.back().push_back(each.arc);
  }
  return lines;
}

} // namespace

Coast without_small(const Coast& coast, double least_area, double radius_km) {
  require(least_area >= 0 && std::isfinite(least_area),
          "the least area of islands and lakes is {}; give 0 or more", least_area);
  require(radius_km > 0 && std::isfinite(radius_km),
          "the radius of the sphere of islands and lakes is {}; give it in km, above 0", radius_km);
  if (least_area == 0)
    return coast;
  constexpr double sphere = 4 * std::numbers::pi;
  const double least = least_area / (radius_km * radius_km); // steradians
  Coast large{.rings = {}, .area = coast.area};
  for (const std::vector<Arc>& line : lines_of(coast)) {
    const double left = domain_detail::area_to_the_left(line), right = sphere - left;
    if (left < least)
      large.area -= left;
    else if (right < least)
      large.area += right;
    else
      large.rings.push_back(ring_of(line));
  }
  require(!large.rings.empty(),
          "all land of the coast is smaller than the least area; give a smaller one");
  return large;
}

} // namespace calotte
