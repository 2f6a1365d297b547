// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/convex_boundary.h"

#include "base/triangle.h"
#include "exact/plane_predicates.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace calotte::mesh_detail {
namespace {

/// From one site on the boundary to the next, with the mesh to the left.
using Edge = std::pair<std::int32_t, std::int32_t>;

/// Sorted by their first sites.
std::vector<Edge> boundary_edges(const PlanarMesh& mesh) {
  std::vector<Edge> edges;
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (mesh.neighbours(v, t) < 0)
        edges.emplace_back(mesh.triangles(next_vertex(v), t),
                           mesh.triangles(previous_vertex(v), t));
  std::sort(edges.begin(), edges.end());
  return edges;
}

} // namespace

bool is_convex(const PlanarMesh& mesh) {
  const std::vector<Edge> edges = boundary_edges(mesh);
  if (edges.empty())
    return false;
  const auto point = [&](std::int32_t site) {
    return Vec2{mesh.points(0, site), mesh.points(1, site)};
  };
  Edge edge = edges.front();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto [next, end] =
        std::equal_range(edges.begin(), edges.end(), Edge(edge.second, 0),
                         [](const Edge& a, const Edge& b) { return a.first < b.first; });
    if (end - next != 1 ||
        orientation(point(edge.first), point(edge.second), point(next->second)) < 0)
      return false;
    edge = *next;
    if (edge == edges.front())
      return k + 1 == edges.size();
  }
  return false;
}

} // namespace calotte::mesh_detail
