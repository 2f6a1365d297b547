// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/adjacency.h"

#include "base/points.h"
#include "exact/plane_predicates.h"
#include "exact/predicates.h"
#include "mesh/by_vertex.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

namespace calotte::mesh_detail {
namespace {

/// Half-edge 3t + i of triangle t, which lies across from its vertex i.
struct HalfEdge {
  std::int32_t lower, higher; ///< its ends
  std::int64_t side;          ///< twice the half-edge, and 1 if it runs up

  std::int64_t half_edge() const { return side / 2; }
  bool runs_up() const { return side % 2 != 0; }
  std::int32_t vertex() const { return lower; }
  bool operator<(const HalfEdge& other) const {
    return std::tie(lower, higher, side) < std::tie(other.lower, other.higher, other.side);
  }
};

HalfEdge half_edge(const Triangles& triangles, std::int64_t h) {
  const std::int64_t t = h / 3, i = h % 3;
  const std::int32_t from = triangles((i + 1) % 3, t), to = triangles((i + 2) % 3, t);
  return {std::min(from, to), std::max(from, to), 2 * h + (from < to)};
}

/// Whether two half-edges of the same ends are two sides of one edge.
bool are_twins(const HalfEdge& a, const HalfEdge& b) {
  return a.runs_up() != b.runs_up() || a.lower == a.higher;
}

/// For each column, the column that represents its site. A column in a triangle represents itself.
/// Any other is represented by the lowest equal column in a triangle, or by the lowest equal column
/// if none is in a triangle.
/// \param compare(a, b) the order of sites; 0 for equal ones.
template <class Compare>
std::vector<std::int32_t> stands_for(const Compare& compare, const std::vector<bool>& in_triangle) {
  std::vector<std::int32_t> order(in_triangle.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::int32_t> result = order;
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const int sign = compare(a, b);
    if (sign != 0)
      return sign < 0;
    const bool a_in = in_triangle[static_cast<std::size_t>(a)];
    const bool b_in = in_triangle[static_cast<std::size_t>(b)];
    return a_in != b_in ? a_in : a < b;
  });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (!in_triangle[static_cast<std::size_t>(order[k])] && compare(order[k - 1], order[k]) == 0)
      result[static_cast<std::size_t>(order[k])] = result[static_cast<std::size_t>(order[k - 1])];
  return result;
}

} // namespace

Triangles neighbours_of(const Triangles& triangles, std::int64_t points) {
  Triangles neighbours;
  neighbours.resize(3, triangles.cols());
  const auto lower = [&](std::int64_t h) { return half_edge(triangles, h).lower; };
  const auto item = [&](std::int64_t h) { return half_edge(triangles, h); };
  const auto link = [&](std::int64_t, const std::vector<HalfEdge>& sorted) {
    for (auto edge = sorted.begin(), end = edge; edge != sorted.end(); edge = end) {
      end = std::find_if(edge, sorted.end(), [&](const HalfEdge& other) {
        return other.lower != edge->lower || other.higher != edge->higher;
      });
      const bool linked = end - edge == 2 && are_twins(edge[0], edge[1]);
      for (auto h = edge; h != end; ++h) {
        const std::int64_t twin = linked ? edge[h == edge ? 1 : 0].half_edge() / 3 : -1;
        neighbours.data()[h->half_edge()] = static_cast<std::int32_t>(twin);
      }
    }
  };
  for_each_vertex_block<std::int64_t, HalfEdge>(triangles.size(), points, lower, item, link);
  return neighbours;
}

Mesh mesh_of_columns(const Points3& columns, const Triangles& triangles, const Surface& surface) {
  const auto count = static_cast<std::size_t>(columns.cols());
  std::vector<bool> in_triangle(count);
  for (const std::int32_t id : triangles.reshaped())
    in_triangle[static_cast<std::size_t>(id)] = true;

  Mesh mesh;
  mesh.surface = surface;
  mesh.points = columns;
  mesh.triangles = triangles;
  mesh.site_of_input.resize(count);
  std::iota(mesh.site_of_input.begin(), mesh.site_of_input.end(), 0);
  if (std::find(in_triangle.begin(), in_triangle.end(), false) != in_triangle.end()) {
    const std::vector<std::int32_t> stands = stands_for(
        [&](std::int32_t a, std::int32_t b) {
          const Vec3 &p = column(columns, a), &q = column(columns, b);
          return surface.is_sphere() ? compare_directions(p, q)
                                     : compare(Vec2{p.x, p.y}, Vec2{q.x, q.y});
        },
        in_triangle);
    std::vector<std::int32_t> site(count, -1);
    std::int32_t sites = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (stands[i] == static_cast<std::int32_t>(i)) {
        mesh.points.col(sites) = columns.col(stands[i]);
        site[i] = sites++;
      }
    for (std::size_t i = 0; i < count; ++i)
      mesh.site_of_input[i] = site[static_cast<std::size_t>(stands[i])];
    mesh.points.conservativeResize(Eigen::NoChange, sites);
    for (std::int32_t& id : mesh.triangles.reshaped())
      id = site[static_cast<std::size_t>(id)];
  }
  mesh.neighbours = neighbours_of(mesh.triangles, mesh.points.cols());
  return mesh;
}

} // namespace calotte::mesh_detail
