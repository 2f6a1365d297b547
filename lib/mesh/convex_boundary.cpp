// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/convex_boundary.h"

#include "exact/plane_predicates.h"
#include "mesh/edge_counts.h"
#include "mesh/faces.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace calotte::mesh_detail {

bool is_convex(const Mesh& mesh) {
  const std::vector<std::int32_t> next = boundary_successors(faces_of(mesh));
  const auto successor = [&](std::int32_t site) { return next[static_cast<std::size_t>(site)]; };
  const auto point = [&](std::int32_t site) {
    return Vec2{mesh.points(0, site), mesh.points(1, site)};
  };
  const auto first = std::find_if(next.begin(), next.end(), [](std::int32_t s) { return s >= 0; });
  if (first == next.end())
    return false;
  const auto start = static_cast<std::int32_t>(first - next.begin());
  const auto count = std::count_if(next.begin(), next.end(), [](std::int32_t s) { return s >= 0; });
  std::int32_t site = start;
  for (std::int64_t k = 1; k <= count; ++k) {
    const std::int32_t middle = successor(site), end = successor(middle);
    if (end < 0 || orientation(point(site), point(middle), point(end)) < 0)
      return false;
    site = middle;
    if (site == start)
      return k == count; // else there are other rings
  }
  return false; // a ring that is left at a site where two pass
}

} // namespace calotte::mesh_detail
