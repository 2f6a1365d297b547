// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/convex_boundary.h"

#include "exact/plane_predicates.h"
#include "mesh/boundary_loops.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace calotte::mesh_detail {

bool is_convex(const Mesh& mesh) {
  const Faces faces = faces_of(mesh);
  const EdgeLoops loops = edge_loops(faces);
  if (loops.size() != 1)
    return false;
  const auto point = [&](std::int32_t site) {
    return Vec2{mesh.points(0, site), mesh.points(1, site)};
  };
  std::int64_t last = loops.items.back();
  return std::ranges::all_of(loops.items, [&](std::int64_t edge) {
    const std::int64_t before = std::exchange(last, edge);
    return orientation(point(start_of(faces, before)), point(start_of(faces, edge)),
                       point(end_of(faces, edge))) >= 0;
  });
}

} // namespace calotte::mesh_detail
