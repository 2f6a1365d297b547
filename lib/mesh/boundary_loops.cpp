// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/boundary_loops.h"

#include "mesh/ids.h"

#include <algorithm>

namespace calotte {
namespace mesh_detail {
namespace {

/// The edge that ends where an outer edge starts, around the triangles between them.
std::int64_t preceding_edge(const Faces& s, std::int64_t edge) {
  const Corner first{static_cast<std::int32_t>(edge / 3), next_vertex(static_cast<int>(edge % 3))};
  const auto next = [&](Corner corner) { return fitting_next(s, corner); };
  const Corner last = walk_around(first, next, [](Corner) {});
  return exists(last) ? 3 * std::int64_t{last.triangle} + next_vertex(last.vertex) : edge;
}

} // namespace

EdgeLoops edge_loops(const Faces& faces) {
  EdgeLoops loops;
  loops.begin.push_back(0);
  std::vector<bool> seen(static_cast<std::size_t>(3 * faces.triangles()));
  for (std::int64_t t = 0; t < faces.triangles(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto start = std::ssize(loops.items);
      if (faces.neighbour(t, i) >= 0)
        continue;
      for (std::int64_t edge = 3 * t + i; !seen[static_cast<std::size_t>(edge)];
           edge = preceding_edge(faces, edge)) {
        seen[static_cast<std::size_t>(edge)] = true;
        loops.items.push_back(edge);
      }
      const auto begin = loops.items.begin() + start;
      if (begin == loops.items.end())
        continue;
      std::reverse(begin, loops.items.end());
      const auto lowest =
          std::min_element(begin, loops.items.end(), [&](std::int64_t a, std::int64_t b) {
            return start_of(faces, a) < start_of(faces, b);
          });
      std::rotate(begin, lowest, loops.items.end());
      loops.begin.push_back(std::ssize(loops.items));
    }
  return loops;
}

} // namespace mesh_detail

IdLists boundary_loops(const Mesh& mesh) {
  using namespace mesh_detail;
  require_triangles(mesh);
  const Faces faces = faces_of(mesh);
  const EdgeLoops loops = edge_loops(faces);
  IdLists out;
  out.begin = Eigen::Map<const Offsets>(loops.begin.data(), std::ssize(loops.begin));
  out.items.resize(std::ssize(loops.items));
  for (Eigen::Index k = 0; k < out.items.size(); ++k) {
    const std::int64_t edge = loops.items[static_cast<std::size_t>(k)];
    if (faces.neighbour(edge / 3, static_cast<int>(edge % 3)) >= 0)
      refuse_at(edge / 3,
                "triangle {} has a neighbour that does not fit it: triangulate the points anew");
    out.items[k] = start_of(faces, edge);
  }
  return out;
}

} // namespace calotte
