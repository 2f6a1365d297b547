// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/require.h"
#include "mesh/room.h"

#include <calotte/types.h>

#include <algorithm>
#include <cstdint>
#include <string>

/// Calls a body for each edge of a spherical or planar mesh once: at the first of its triangles.
namespace calotte::mesh_detail {

template <class AnyMesh> bool is_first(const AnyMesh& mesh, std::int64_t t, int i) {
  return mesh.neighbours(i, t) < 0 || mesh.neighbours(i, t) > t;
}

/// \throws Error bad_option if the mesh lacks neighbours, or has more edges and sites than
///         most_points.
template <class AnyMesh> std::int64_t count_edges(const AnyMesh& mesh) {
  const std::int64_t n = mesh.points.cols(), triangles = mesh.triangles.cols();
  require(mesh.neighbours.cols() == triangles,
          "the mesh has " + std::to_string(triangles) + " triangles but neighbours of " +
              std::to_string(mesh.neighbours.cols()) + "; give a mesh with both");
  std::int64_t edges = 0;
  for (std::int64_t t = 0; t < triangles; ++t)
    for (int i = 0; i < 3; ++i)
      edges += is_first(mesh, t, i);
  require(n + edges <= most_points,
          "bisection gives more than " + std::to_string(most_points) + " points; give fewer");
  return edges;
}

/// body(a, b) for the ends of each edge, in the order of the triangles, edge i of a triangle across
/// from its vertex i. \pre count_edges(). \throws Error bad_option for an id outside the mesh.
template <class AnyMesh, class Body> void for_each_edge(const AnyMesh& mesh, const Body& body) {
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      if (!is_first(mesh, t, i))
        continue;
      const std::int32_t a = mesh.triangles((i + 1) % 3, t), b = mesh.triangles((i + 2) % 3, t);
      require(std::min(a, b) >= 0 && std::max(a, b) < mesh.points.cols(),
              "triangle " + std::to_string(t) + " has a vertex outside the mesh's points");
      body(a, b);
    }
}

} // namespace calotte::mesh_detail
