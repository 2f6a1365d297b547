// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/triangulate.h"

#include <algorithm>
#include <vector>

namespace calotte::delaunay_detail {

/// Triangulates the members together with sites sampled from the whole set; empty if these span no
/// triangle either.
template <class Chart>
Triangulation<Chart> build_with_sample(const Chart& chart, std::int64_t sites,
                                       std::vector<Member> members) {
  constexpr std::int64_t sample = 64;
  for (std::int64_t s = 0; s < std::min(sample, sites); ++s)
    members.push_back(
        {static_cast<std::int32_t>(s * sites / std::min(sample, sites)), Member::not_owned});
  const auto by_rank = [](const Member& a, const Member& b) { return a.rank < b.rank; };
  const auto same_rank = [](const Member& a, const Member& b) { return a.rank == b.rank; };
  std::stable_sort(members.begin(), members.end(),
                   by_rank); // stable: a member precedes its duplicate
  members.erase(std::unique(members.begin(), members.end(), same_rank), members.end());
  std::erase_if(members, [&](const Member& m) { return !chart.has_point(m.rank); });
  Triangulation<Chart> triangulation(chart);
  triangulation.build(members);
  return triangulation;
}

} // namespace calotte::delaunay_detail
