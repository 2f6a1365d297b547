// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/adjacency.h"

#include "exact/plane_predicates.h"
#include "exact/predicates.h"

#include <algorithm>
#include <numeric>

namespace calotte::mesh_detail {
namespace {

/// Half-edge 3t + i of triangle t lies across from its vertex i.
struct HalfEdge {
  std::int32_t from, to;
};

HalfEdge half_edge(const Triangles& triangles, std::int64_t h) {
  const std::int64_t t = h / 3, i = h % 3;
  return {triangles((i + 1) % 3, t), triangles((i + 2) % 3, t)};
}

/// Half-edges by their lower vertex: those of vertex v are list[first[v]] to list[first[v+1]].
struct HalfEdgesOfVertices {
  std::vector<std::int64_t> first, list;
};

HalfEdgesOfVertices by_lower_vertex(const Triangles& triangles, std::int64_t points) {
  const std::int64_t count = 3 * triangles.cols();
  HalfEdgesOfVertices edges{std::vector<std::int64_t>(static_cast<std::size_t>(points) + 2),
                            std::vector<std::int64_t>(static_cast<std::size_t>(count))};
  const auto slot = [&](std::int64_t h) -> std::int64_t& {
    const HalfEdge e = half_edge(triangles, h);
    return edges.first[static_cast<std::size_t>(std::min(e.from, e.to)) + 1];
  };
  // Counts stand two places on, so that filling the lists turns them into the lists' starts.
  for (std::int64_t h = 0; h < count; ++h)
    ++*(&slot(h) + 1);
  std::partial_sum(edges.first.begin(), edges.first.end(), edges.first.begin());
  for (std::int64_t h = 0; h < count; ++h)
    edges.list[static_cast<std::size_t>(slot(h)++)] = h;
  return edges;
}

/// What is known of the edge from the current lower vertex to a higher one.
struct Meeting {
  std::int32_t lower = -1;
  int half_edges = 0;
  std::int64_t one = -1, other = -1;
};

void link(const Triangles& triangles, std::int64_t h, Meeting& edge, Triangles& neighbours) {
  if (++edge.half_edges == 1) {
    edge.one = h;
  } else if (edge.half_edges == 2) {
    edge.other = h;
    if (half_edge(triangles, edge.one).from == half_edge(triangles, h).to) {
      neighbours.data()[h] = static_cast<std::int32_t>(edge.one / 3);
      neighbours.data()[edge.one] = static_cast<std::int32_t>(h / 3);
    }
  } else {
    neighbours.data()[edge.one] = neighbours.data()[edge.other] = -1;
  }
}

/// The order of sites; 0 for equal ones.
int compare_columns(const Points3& points, std::int32_t a, std::int32_t b) {
  const auto column = [&](std::int32_t i) {
    return Vec3{points(0, i), points(1, i), points(2, i)};
  };
  return compare_directions(column(a), column(b));
}

int compare_columns(const Points2& points, std::int32_t a, std::int32_t b) {
  return compare(Vec2{points(0, a), points(1, a)}, Vec2{points(0, b), points(1, b)});
}

/// For each column the one that stands for its site: a column in a triangle for itself, any other
/// for the lowest equal one in a triangle, or if there is none the lowest equal one.
template <class Points>
std::vector<std::int32_t> stands_for(const Points& columns, const std::vector<bool>& in_triangle) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(columns.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::int32_t> result = order;
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const int sign = compare_columns(columns, a, b);
    if (sign != 0)
      return sign < 0;
    const bool a_in = in_triangle[static_cast<std::size_t>(a)];
    const bool b_in = in_triangle[static_cast<std::size_t>(b)];
    return a_in != b_in ? a_in : a < b;
  });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (!in_triangle[static_cast<std::size_t>(order[k])] &&
        compare_columns(columns, order[k - 1], order[k]) == 0)
      result[static_cast<std::size_t>(order[k])] = result[static_cast<std::size_t>(order[k - 1])];
  return result;
}

} // namespace

Triangles neighbours_of(const Triangles& triangles, std::int64_t points) {
  Triangles neighbours = Triangles::Constant(3, triangles.cols(), -1);
  const HalfEdgesOfVertices edges = by_lower_vertex(triangles, points);
  std::vector<Meeting> meetings(static_cast<std::size_t>(points));
  for (std::int32_t v = 0; v < points; ++v) {
    const auto begin = edges.list.begin() + edges.first[static_cast<std::size_t>(v)];
    const auto end = edges.list.begin() + edges.first[static_cast<std::size_t>(v) + 1];
    for (auto h = begin; h != end; ++h) {
      const HalfEdge e = half_edge(triangles, *h);
      Meeting& edge = meetings[static_cast<std::size_t>(std::max(e.from, e.to))];
      if (edge.lower != v)
        edge = {.lower = v};
      link(triangles, *h, edge, neighbours);
    }
  }
  return neighbours;
}

namespace {

template <class AnyMesh, class Points>
AnyMesh mesh_of(const Points& columns, const Triangles& triangles) {
  const auto count = static_cast<std::size_t>(columns.cols());
  std::vector<bool> in_triangle(count);
  for (const std::int32_t id : triangles.reshaped())
    in_triangle[static_cast<std::size_t>(id)] = true;

  AnyMesh mesh;
  mesh.points = columns;
  mesh.triangles = triangles;
  mesh.site_of_input.resize(count);
  std::iota(mesh.site_of_input.begin(), mesh.site_of_input.end(), 0);
  if (std::find(in_triangle.begin(), in_triangle.end(), false) != in_triangle.end()) {
    const std::vector<std::int32_t> stands = stands_for(columns, in_triangle);
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

} // namespace

Mesh mesh_of_columns(const Points3& columns, const Triangles& triangles) {
  return mesh_of<Mesh>(columns, triangles);
}

PlanarMesh mesh_of_columns(const Points2& columns, const Triangles& triangles) {
  return mesh_of<PlanarMesh>(columns, triangles);
}

} // namespace calotte::mesh_detail
