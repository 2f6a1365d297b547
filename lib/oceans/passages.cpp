// SPDX-License-Identifier: GPL-3.0-or-later
#include "oceans/passages.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

namespace calotte::oceans_detail {
namespace {

std::int32_t nearest_site(const ShoreMesh& shore, const Vec3& point) {
  std::int32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t site = 0; site < shore.size(); ++site) {
    const Vec3 apart = column(shore.at.points, site) - point;
    if (const double square = dot(apart, apart); square < least) {
      least = square;
      nearest = site;
    }
  }
  return nearest;
}

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

/// The sites of the shortest way from the end of a passage to the core of the sea; none without a
/// way.
std::vector<std::int32_t> way_to_core(const ShoreMesh& shore, const LineDistance& line,
                                      const Vec3& end) {
  using Front = std::pair<double, std::int32_t>; // the length of a way, and its last site
  struct Reached {
    double length;
    std::int32_t before;
  };
  std::unordered_map<std::int32_t, Reached> reached;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
  const std::int32_t start = nearest_site(shore, end);
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
  std::vector<Points3> continued;
  for (const Points3& line : lines) {
    const LineDistance distance({line}, {});
    const auto way = [&](Eigen::Index end) {
      return way_to_core(shore, distance, normalised(column(line, end)));
    };
    const std::vector<std::int32_t> before = way(0), after = way(line.cols() - 1);
    Points3& all = continued.emplace_back(3, line.cols() + std::ssize(before) + std::ssize(after));
    Eigen::Index k = 0;
    for (auto site = before.rbegin(); site != before.rend(); ++site)
      all.col(k++) = shore.at.points.col(*site);
    for (const auto& point : line.colwise())
      all.col(k++) = point;
    for (const std::int32_t site : after)
      all.col(k++) = shore.at.points.col(site);
  }
  return continued;
}

} // namespace calotte::oceans_detail
