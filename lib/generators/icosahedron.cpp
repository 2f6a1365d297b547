// SPDX-License-Identifier: GPL-3.0-or-later
#include "generators/icosahedron.h"

#include <calotte/generators.h>

#include "base/points.h"
#include "base/require.h"
#include "exact/space.h"

#include <algorithm>
#include <cmath>

namespace calotte {
namespace generators_detail {

std::array<Vec3, icosahedron_vertices> icosahedron_points() {
  constexpr double s = 0x1.0d2ca0da1530dp-1, t = 0x1.b38880b4603e4p-1;
  return {Vec3{0, s, t}, {0, -s, t},  {0, s, -t}, {0, -s, -t}, {s, t, 0},  {-s, t, 0},
          {s, -t, 0},    {-s, -t, 0}, {t, 0, s},  {t, 0, -s},  {-t, 0, s}, {-t, 0, -s}};
}

EdgeMesh icosahedron() {
  EdgeMesh mesh;
  mesh.triangles = {{0, 1, 8},  {0, 10, 1}, {0, 8, 4},   {0, 4, 5},  {0, 5, 10},
                    {1, 10, 7}, {1, 7, 6},  {1, 6, 8},   {2, 3, 11}, {2, 9, 3},
                    {2, 11, 5}, {2, 5, 4},  {2, 4, 9},   {3, 9, 6},  {3, 6, 7},
                    {3, 7, 11}, {4, 8, 9},  {5, 11, 10}, {6, 9, 8},  {7, 10, 11}};
  for (const EdgeMesh::Triple& triangle : mesh.triangles) {
    EdgeMesh::Triple edges{};
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(triangle[(i + 1) % 3], triangle[(i + 2) % 3]);
      const std::array<std::int32_t, 2> edge{a, b};
      const auto found = std::find(mesh.edges.begin(), mesh.edges.end(), edge);
      edges[i] = static_cast<std::int32_t>(found - mesh.edges.begin());
      if (found == mesh.edges.end())
        mesh.edges.push_back(edge);
    }
    mesh.triangle_edges.push_back(edges);
  }
  return mesh;
}

} // namespace generators_detail

namespace {

using namespace generators_detail;
using Triple = EdgeMesh::Triple;

/// Divides every triangle in four. The midpoint of edge e is vertex `vertices` + e. Edge e becomes
/// the edges 2e, at its first vertex, and 2e + 1. The edges inside the triangles follow.
EdgeMesh refine(const EdgeMesh& coarse, std::int32_t vertices) {
  EdgeMesh fine;
  const std::size_t edge_count = coarse.edges.size(), triangle_count = coarse.triangles.size();
  fine.edges.resize(2 * edge_count + 3 * triangle_count);
  fine.triangles.resize(4 * triangle_count);
  fine.triangle_edges.resize(4 * triangle_count);
  for (std::size_t e = 0; e < edge_count; ++e) {
    const std::int32_t middle = vertices + static_cast<std::int32_t>(e);
    fine.edges[2 * e] = {coarse.edges[e][0], middle};
    fine.edges[2 * e + 1] = {middle, coarse.edges[e][1]};
  }
  const auto half_at = [&](std::int32_t side, std::int32_t corner) {
    return 2 * side + (coarse.edges[static_cast<std::size_t>(side)][0] == corner ? 0 : 1);
  };
  for (std::size_t t = 0; t < triangle_count; ++t) {
    const Triple &corners = coarse.triangles[t], &sides = coarse.triangle_edges[t];
    const Triple middles{vertices + sides[0], vertices + sides[1], vertices + sides[2]};
    const std::size_t first = 2 * edge_count + 3 * t;
    const auto inner = static_cast<std::int32_t>(first);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      fine.edges[first + i] = {middles[j], middles[k]};
      fine.triangles[4 * t + i] = {corners[i], middles[k], middles[j]};
      fine.triangle_edges[4 * t + i] = {inner + static_cast<std::int32_t>(i),
                                        half_at(sides[j], corners[i]),
                                        half_at(sides[k], corners[i])};
    }
    fine.triangles[4 * t + 3] = middles;
    fine.triangle_edges[4 * t + 3] = {inner, inner + 1, inner + 2};
  }
  return fine;
}

} // namespace

Points3 bisected_icosahedron(int level) {
  base_detail::require(level >= 0 && level <= 13, "the level is {}; give a number from 0 to 13",
                       level);
  std::int32_t count = 12;
  Points3 points(3, 10 * (std::int64_t{1} << (2 * level)) + 2);
  const std::array<Vec3, 12> corners = icosahedron_points();
  for (std::int32_t i = 0; i < count; ++i)
    base_detail::set_column(points, i, corners[static_cast<std::size_t>(i)]);
  EdgeMesh mesh = icosahedron();
  for (int l = 0; l < level; ++l) {
    if (l > 0)
      mesh = refine(mesh, count - static_cast<std::int32_t>(mesh.edges.size()));
    for (const auto& [a, b] : mesh.edges)
      base_detail::set_column(
          points, count++,
          Sphere::midpoint(base_detail::column(points, a), base_detail::column(points, b)));
  }
  return points;
}

} // namespace calotte
