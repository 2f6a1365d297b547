// SPDX-License-Identifier: GPL-3.0-or-later
#include "oceans/passages.h"

#include <calotte/locate.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

namespace calotte::oceans_detail {
namespace {

/// Whether a way from the end of a passage may pass through a site: in the sea or in a passage, but
/// not along its own.
bool is_passable(const ShoreMesh& shore, const LineDistance& line, const Vec3& end,
                 std::int32_t site) {
  const Vec3& point = column(shore.at.points, site);
  const double half = 0.5 * shore.width(site);
  if (shore.at.from_passage[static_cast<std::size_t>(site)] > half)
    return shore.from_coast(site) > 0;
  return norm(point - end) <= half || line(point) > half;
}

/// The sites of the shortest way from the end of a passage, whose nearest site is `start`, to the
/// core of the sea; none without a way.
std::vector<std::int32_t> way_to_core(const ShoreMesh& shore, const LineDistance& line,
                                      const Vec3& end, std::int32_t start) {
  using Front = std::pair<double, std::int32_t>; // the length of a way, and its last site
  struct Reached {
    double length;
    std::int32_t before;
  };
  std::unordered_map<std::int32_t, Reached> reached;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
  reached[start] = {0, -1};
  for (fronts.emplace(0, start); !fronts.empty();) {
    const auto [length, site] = fronts.top();
    fronts.pop();
    if (length > reached[site].length)
      continue;
    if (shore.core(site) >= 0) {
      std::vector<std::int32_t> way;
      for (std::int32_t at = site; at >= 0; at = reached[at].before)
        way.push_back(at);
      std::reverse(way.begin(), way.end());
      return way;
    }
    for (const std::int32_t other : shore.neighbours[site]) {
      const double longer =
          length + norm(column(shore.at.points, other) - column(shore.at.points, site));
      const auto known = reached.find(other);
      if ((known == reached.end() || longer < known->second.length) &&
          is_passable(shore, line, end, other)) {
        reached[other] = {longer, site};
        fronts.emplace(longer, other);
      }
    }
  }
  return {};
}

} // namespace

std::vector<Points3> continued_passages(const ShoreMesh& shore, const std::vector<Points3>& lines) {
  Points3 ends(3, 2 * std::ssize(lines));
  for (std::size_t k = 0; k < lines.size(); ++k)
    ends.middleCols<2>(2 * static_cast<Eigen::Index>(k)) << lines[k].leftCols<1>(),
        lines[k].rightCols<1>();
  const Ids starts = locate(shore.mesh, ends).nearest;
  std::vector<Points3> continued;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Points3& line = lines[k];
    const LineDistance distance({line}, {});
    const auto way = [&](Eigen::Index end) {
      return way_to_core(shore, distance, normalised(column(ends, end)), starts[end]);
    };
    const auto end = 2 * static_cast<Eigen::Index>(k);
    const std::vector<std::int32_t> before = way(end), after = way(end + 1);
    Points3& all = continued.emplace_back(3, line.cols() + std::ssize(before) + std::ssize(after));
    Eigen::Index to = 0;
    for (auto site = before.rbegin(); site != before.rend(); ++site)
      all.col(to++) = shore.at.points.col(*site);
    for (const auto& point : line.colwise())
      all.col(to++) = point;
    for (const std::int32_t site : after)
      all.col(to++) = shore.at.points.col(site);
  }
  return continued;
}

} // namespace calotte::oceans_detail
