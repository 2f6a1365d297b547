// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "exact.h"

#include <calotte/mesh.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

/// Meshes computed in a slow and simple way, as the reference for the library's.
namespace calotte::oracle {

using Triple = std::array<std::int32_t, 3>;

inline base_detail::Vec3 site(const Points3& points, std::int64_t i) {
  return {points(0, i), points(1, i), points(2, i)};
}

/// Rotates each triangle to its lowest vertex, sorts them, and finds the neighbours by their edges.
inline Mesh mesh_of(const Points3& points, std::vector<Triple> triangles) {
  for (Triple& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  Mesh mesh;
  mesh.points = points;
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  mesh.neighbours.setConstant(3, mesh.triangles.cols(), -1);
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> triangle_of_edge;
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      mesh.triangles(i, t) = triangles[t][i];
      triangle_of_edge[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
    }
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto twin =
          triangle_of_edge.find({triangles[t][(i + 2) % 3], triangles[t][(i + 1) % 3]});
      if (twin != triangle_of_edge.end())
        mesh.neighbours(i, t) = twin->second;
    }
  mesh.site_of_input.resize(static_cast<std::size_t>(points.cols()));
  std::iota(mesh.site_of_input.begin(), mesh.site_of_input.end(), 0);
  return mesh;
}

/// The Delaunay triangulation of distinct directions by its definition: every counter-clockwise
/// triple whose circumcap holds no other site, ties by the library's rule. O(n^4) exact signs.
inline Mesh delaunay(const Points3& points) {
  const auto n = static_cast<std::int32_t>(points.cols());
  std::vector<Triple> triangles;
  for (std::int32_t a = 0; a < n; ++a)
    for (std::int32_t b = a + 1; b < n; ++b)
      for (std::int32_t c = b + 1; c < n; ++c) {
        const int way = exact::orientation(site(points, a), site(points, b), site(points, c));
        if (way == 0)
          continue;
        const Triple t = way > 0 ? Triple{a, b, c} : Triple{a, c, b};
        bool empty = true;
        for (std::int32_t d = 0; d < n && empty; ++d)
          empty = d == a || d == b || d == c ||
                  exact::in_circle_resolved({}, site(points, t[0]), site(points, t[1]),
                                            site(points, t[2]), site(points, d)) < 0;
        if (empty)
          triangles.push_back(t);
      }
  return mesh_of(points, std::move(triangles));
}

} // namespace calotte::oracle
