// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/ocean.h>

#include "base/require.h"
#include "domain/spherical_area.h"
#include "oceans/coast_sides.h"
#include "oceans/small_land.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace calotte {
namespace oceans_detail {
namespace {

/// The corners of a closed line, in its order.
Points3 ring_of(const std::vector<Arc>& line) {
  Points3 ring(3, std::ssize(line));
  for (std::size_t k = 0; k < line.size(); ++k)
    set_column(ring, static_cast<Eigen::Index>(k), line[k].from);
  return ring;
}

} // namespace

std::vector<std::vector<Arc>> closed_lines(const Coast& coast) {
  std::vector<std::vector<Arc>> lines;
  for (const CoastArc& each : coast_arcs(coast)) {
    if (each.line == std::ssize(lines))
      lines.emplace_back();
    lines.back().push_back(each.arc);
  }
  return lines;
}

LargeCoast large_lines(const Coast& coast, const std::vector<std::vector<Arc>>& lines,
                       std::span<const double> least) {
  constexpr double sphere = 4 * std::numbers::pi;
  LargeCoast large{.coast = {.rings = {}, .area = coast.area}};
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double left = domain_detail::area_to_the_left(lines[k]), right = sphere - left;
    if (left < least[k]) {
      ++large.islands;
      large.islands_area += left;
    } else if (right < least[k]) {
      ++large.lakes;
      large.lakes_area += right;
    } else {
      large.coast.rings.push_back(ring_of(lines[k]));
    }
  }
  large.coast.area += large.lakes_area - large.islands_area;
  return large;
}

} // namespace oceans_detail

Coast without_small(const Coast& coast, double least_area, double radius_km) {
  using namespace oceans_detail;
  require(least_area >= 0 && std::isfinite(least_area),
          "the least area of islands and lakes is {}; give 0 or more", least_area);
  require(radius_km > 0 && std::isfinite(radius_km),
          "the radius of the sphere of islands and lakes is {}; give it in km, above 0", radius_km);
  if (least_area == 0)
    return coast;
  const std::vector<std::vector<Arc>> lines = closed_lines(coast);
  const std::vector<double> least(lines.size(), least_area / (radius_km * radius_km));
  Coast large = large_lines(coast, lines, least).coast;
  require(!large.rings.empty(),
          "all land of the coast is smaller than the least area; give a smaller one");
  return large;
}

} // namespace calotte
