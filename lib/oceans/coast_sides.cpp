// SPDX-License-Identifier: GPL-3.0-or-later
#include "oceans/coast_sides.h"

#include "base/lonlat.h"
#include "base/message.h"
#include "base/points.h"
#include "base/require.h"
#include "domain/rings.h"
#include "exact/predicates.h"

#include <calotte/ocean.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

namespace calotte {
namespace oceans_detail {
namespace {

using domain_detail::as_unit;
using exact_detail::same_direction;

/// The corners of a ring, without those that repeat the previous one.
std::vector<Vec3> corners_of(const Points3& ring, std::int64_t number) {
  domain_detail::require_directions(ring, number);
  std::vector<Vec3> corners;
  for (Eigen::Index i = 0; i < ring.cols(); ++i) {
    const Vec3 corner = as_unit(column(ring, i));
    if (!corners.empty() && same_direction(corners.back(), corner))
      continue;
    const Vec3 middle = corners.empty() ? corner : corners.back() + corner;
    require(dot(middle, middle) > 1e-20,
            "ring {} of the coast, corner {} is opposite to the one before; "
            "give a corner between them",
            number, i);
    corners.push_back(corner);
  }
  return corners;
}

std::array<double, 6> ends(const Vec3& from, const Vec3& to) {
  return {from.x, from.y, from.z, to.x, to.y, to.z};
}

using ArcStart = std::pair<std::array<double, 3>, std::size_t>; ///< of an arc, and its index

std::array<double, 3> coordinates(const Vec3& x) { return {x.x, x.y, x.z}; }

/// Joins arcs to closed lines: the arcs as they follow each other.
std::vector<CoastArc> joined_lines(const std::vector<Arc>& arcs) {
  std::vector<ArcStart> starts;
  for (std::size_t k = 0; k < arcs.size(); ++k)
    starts.emplace_back(coordinates(arcs[k].from), k);
  std::sort(starts.begin(), starts.end());
  std::vector<bool> used(arcs.size());
  const auto after = [&](std::size_t arc) {
    const std::array<double, 3> end = coordinates(arcs[arc].to);
    // Where several arcs begin, the line continues with the next arc of the ring.
    if (arc + 1 < arcs.size() && !used[arc + 1] && coordinates(arcs[arc + 1].from) == end)
      return arc + 1;
    for (auto next = std::lower_bound(starts.begin(), starts.end(), ArcStart{end, 0});
         next != starts.end() && next->first == end; ++next)
      if (!used[next->second])
        return next->second;
    return arcs.size();
  };
  std::vector<CoastArc> lines;
  std::int32_t line = 0;
  for (std::size_t first = 0; first < arcs.size(); ++first) {
    if (used[first])
      continue;
    for (std::size_t arc = first; arc < arcs.size(); arc = after(arc)) {
      used[arc] = true;
      lines.push_back({arcs[arc], line});
    }
    ++line;
  }
  return lines;
}

std::vector<SideCells::Corner> corners_between(const std::vector<CoastArc>& arcs) {
  std::vector<SideCells::Corner> corners;
  for (std::int32_t k = 0; k < std::ssize(arcs); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const std::int32_t next = k + 1 < std::ssize(arcs) ? k + 1 : 0;
    const Vec3 &to = arcs[at].arc.to, &from = arcs[static_cast<std::size_t>(next)].arc.from;
    if (to.x == from.x && to.y == from.y && to.z == from.z)
      corners.push_back({k, next});
  }
  return corners;
}

/// Whether the inside is land, by the majority of the corners, which have land to their left. At
/// some corners, simplified coasts cross themselves.
bool inside_is_land(const SideCells& cells, const std::vector<SideCells::Corner>& corners) {
  const auto left = std::count_if(corners.begin(), corners.end(), [&](SideCells::Corner corner) {
    return cells.inside_is_left(corner);
  });
  const auto all = std::ssize(corners), most = std::max(left, all - left);
  require(10 * most >= 9 * all, "areas of land overlap; give them united");
  return 2 * left > all;
}

std::vector<Arc> without_lines(const std::vector<CoastArc>& arcs) {
  std::vector<Arc> result;
  for (const CoastArc& each : arcs)
    result.push_back(each.arc);
  return result;
}

/// Refuses a coast that repeats many of its arcs: areas of land that it contains twice would have
/// no defined sides. Cuts of a coast may repeat some arcs.
const std::vector<CoastArc>& require_distinct(const std::vector<CoastArc>& arcs) {
  constexpr std::size_t share = 20;
  std::set<std::array<double, 6>> seen;
  std::size_t repeated = 0;
  Vec3 last{};
  for (const CoastArc& each : arcs)
    if (!seen.insert(ends(each.arc.from, each.arc.to)).second) {
      ++repeated;
      last = each.arc.from;
    }
  if (share * repeated > arcs.size()) {
    const base_detail::LonLat at = base_detail::lonlat_of(last);
    refuse(message("areas of land are there twice, one with a corner at longitude {}, "
                   "latitude {}; give each once",
                   at.longitude, at.latitude));
  }
  return arcs;
}

} // namespace

CoastSides::CoastSides(const std::vector<CoastArc>& arcs)
    : cells_(without_lines(require_distinct(arcs)), corners_between(arcs).front()) {
  if (!inside_is_land(cells_, corners_between(arcs)))
    std::swap(land_, sea_);
}

namespace {

/// The arcs of all rings.
std::vector<Arc> ring_arcs(const Coast& coast) {
  std::vector<Arc> all;
  for (std::size_t r = 0; r < coast.rings.size(); ++r) {
    const std::vector<Vec3> corners = corners_of(coast.rings[r], static_cast<std::int64_t>(r));
    for (std::size_t k = 0; k < corners.size(); ++k)
      all.push_back({corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]});
  }
  return all;
}

} // namespace

std::vector<CoastArc> coast_arcs(const Coast& coast) {
  using Key = std::pair<std::array<double, 6>, std::size_t>; // ends of an arc, and its index
  const std::vector<Arc> all = ring_arcs(coast);
  std::vector<Key> sorted;
  for (std::size_t k = 0; k < all.size(); ++k)
    sorted.emplace_back(ends(all[k].from, all[k].to), k);
  std::sort(sorted.begin(), sorted.end());
  const auto before = [&](const Vec3& from, const Vec3& to, std::size_t index) {
    return std::lower_bound(sorted.begin(), sorted.end(), Key(ends(from, to), index)) -
           sorted.begin();
  };
  std::vector<Arc> kept;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& [from, to] = all[k];
    const auto back = before(to, from, all.size()) - before(to, from, 0);
    if (back == 0 || before(from, to, k) - before(from, to, 0) >= back)
      kept.push_back(all[k]);
  }
  return joined_lines(kept);
}

} // namespace oceans_detail

std::vector<Points3> shores(const Coast& coast) {
  std::vector<Points3> lines;
  for (const oceans_detail::CoastArc& each : oceans_detail::coast_arcs(coast)) {
    const auto& [from, to] = each.arc;
    lines.emplace_back(3, 2) << from.x, to.x, from.y, to.y, from.z, to.z;
  }
  return lines;
}

} // namespace calotte
