// SPDX-License-Identifier: GPL-3.0-or-later
#include "oceans/level_rings.h"

#include "mesh/faces.h"

#include <algorithm>
#include <vector>

namespace calotte::oceans_detail {

std::vector<std::vector<LevelPoint>> level_rings(const Mesh& mesh, std::span<const double> values) {
  const mesh_detail::Faces faces = mesh_detail::faces_of(mesh);
  const auto value = [&](std::int64_t t, int i) {
    return values[static_cast<std::size_t>(faces.vertex(t, i))];
  };
  // A ring enters a triangle where, counter-clockwise, the values become negative, and leaves it
  // where they cease to be. Edge i runs from vertex i to the next.
  const auto edge_where = [&](std::int64_t t, bool enters) {
    for (int i = 0; i < 3; ++i)
      if ((value(t, i) < 0) != enters && (value(t, i + 1) < 0) == enters)
        return i;
    return -1;
  };
  const auto point_on = [&](std::int64_t t, int edge) {
    constexpr double margin = 0.05;
    const double above = value(t, edge), below = value(t, edge + 1);
    return LevelPoint{faces.vertex(t, edge), faces.vertex(t, edge + 1),
                      std::clamp(above / (above - below), margin, 1 - margin)};
  };
  std::vector<bool> passed(static_cast<std::size_t>(faces.triangles()));
  std::vector<std::vector<LevelPoint>> rings;
  for (std::int64_t first = 0; first < faces.triangles(); ++first) {
    if (passed[static_cast<std::size_t>(first)] || edge_where(first, true) < 0)
      continue;
    rings.emplace_back();
    for (std::int64_t t = first; !passed[static_cast<std::size_t>(t)];
         t = faces.neighbour(t, edge_where(t, false) + 2)) {
      passed[static_cast<std::size_t>(t)] = true;
      rings.back().push_back(point_on(t, edge_where(t, true)));
    }
  }
  return rings;
}

} // namespace calotte::oceans_detail
