// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/rule_shares.h"

#include <calotte/generators.h>
#include <calotte/mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace calotte::tools {
namespace {

/// Random points of a surface, each near the one before, for which rules take less time.
Points3 sorted_points(const Surface& surface, const Density& density) {
  constexpr std::int64_t count = 200'000;
  constexpr double bands = 100; // of latitude, in each hemisphere
  const Points3 points = random_points(count, surface, density);
  std::vector<std::tuple<double, double, Eigen::Index>> order;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    order.emplace_back(std::floor(bands * points(2, i)), std::atan2(points(1, i), points(0, i)), i);
  std::sort(order.begin(), order.end());
  Points3 sorted(3, points.cols());
  for (std::size_t k = 0; k < order.size(); ++k)
    sorted.col(static_cast<Eigen::Index>(k)) = points.col(std::get<2>(order[k]));
  return sorted;
}

} // namespace

std::vector<RuleShare> rule_shares(const WidthRules& rules, const Surface& surface,
                                   const Density& density) {
  // Points that follow the cells find rules of small parts with many of them.
  const Ids by_area = active_rules(rules.widths, sorted_points(surface, {})),
            by_cells =
                active_rules(rules.widths, sorted_points(surface, site_density(density, surface)));
  const auto share = [](const Ids& active, std::size_t rule) {
    return (active.array() == static_cast<std::int32_t>(rule)).cast<double>().mean();
  };
  std::vector<RuleShare> shares;
  for (std::size_t rule = 0; rule < rules.names.size(); ++rule)
    shares.push_back({rules.names[rule], share(by_area, rule), share(by_cells, rule)});
  return shares;
}

} // namespace calotte::tools
