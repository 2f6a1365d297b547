// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "base/require.h"
#include "mesh/ids.h"
#include "mesh/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <span>
#include <vector>

/// Calls a body for each edge of a spherical or planar mesh once: at the first of its triangles.
namespace calotte::mesh_detail {

template <class AnyMesh> bool is_first(const AnyMesh& mesh, std::int64_t t, int i) {
  return mesh.neighbours(i, t) < 0 || mesh.neighbours(i, t) > t;
}

/// Calls body(a, b) for the ends of each edge whose first triangle is in a range, in the order of
/// the triangles. Edge i of a triangle lies across from its vertex i.
template <class AnyMesh, class Body>
void for_each_edge_of(const AnyMesh& mesh, std::int64_t begin, std::int64_t end, const Body& body) {
  for (std::int64_t t = begin; t != end; ++t)
    for (int i = 0; i < 3; ++i)
      if (is_first(mesh, t, i))
        body(mesh.triangles((i + 1) % 3, t), mesh.triangles((i + 2) % 3, t));
}

/// \throws Error invalid_argument for a vertex outside the mesh.
template <class AnyMesh> void require_vertices(const AnyMesh& mesh) {
  if (are_ids(mesh.triangles, mesh.points.cols()))
    return;
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
    require(mesh.triangles.col(t).minCoeff() >= 0 &&
                mesh.triangles.col(t).maxCoeff() < mesh.points.cols(),
            "triangle {} has a vertex outside the mesh's points", t);
}

/// The edges of a mesh.
struct EdgeCount {
  std::vector<std::int64_t> before; ///< the first of each block of triangles
  std::int64_t all = 0;
};

/// \throws Error invalid_argument if the mesh lacks neighbours, has a vertex outside of it, or more
///         edges and sites than most_points.
template <class AnyMesh> EdgeCount count_edges(const AnyMesh& mesh) {
  const std::int64_t n = mesh.points.cols(), triangles = mesh.triangles.cols();
  require_neighbours(mesh);
  require_vertices(mesh);
  EdgeCount edges;
  edges.before.resize(static_cast<std::size_t>(base_detail::block_count(triangles)));
  base_detail::for_each_block(
      triangles, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        std::int64_t here = 0;
        for_each_edge_of(mesh, begin, end, [&](std::int32_t, std::int32_t) { ++here; });
        edges.before[static_cast<std::size_t>(block)] = here;
      });
  edges.all = base_detail::exclusive_scan(std::span(edges.before));
  require(n + edges.all <= most_points, "bisection gives more than {} points; give fewer",
          most_points);
  return edges;
}

/// Calls body(a, b) for the ends of each edge, one after the other. \pre the vertices are in the
/// mesh.
template <class AnyMesh, class Body> void for_each_edge(const AnyMesh& mesh, const Body& body) {
  for_each_edge_of(mesh, 0, mesh.triangles.cols(), body);
}

/// Calls body(e, a, b) for each edge e, in parallel.
/// \param edges of the mesh, as count_edges() gives them.
template <class AnyMesh, class Body>
void for_each_edge(const AnyMesh& mesh, const EdgeCount& edges, const Body& body) {
  base_detail::for_each_block(mesh.triangles.cols(), [&](std::int64_t block, std::int64_t begin,
                                                         std::int64_t end) {
    std::int64_t e = edges.before[static_cast<std::size_t>(block)];
    for_each_edge_of(mesh, begin, end, [&](std::int32_t a, std::int32_t b) { body(e++, a, b); });
  });
}

} // namespace calotte::mesh_detail
