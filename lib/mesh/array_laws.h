// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "mesh/faces.h"
#include "mesh/failures.h"

#include <array>
#include <limits>
#include <string>

/// The laws of a mesh's arrays: ids in range, canonical order, mutual neighbours. A law returns its
/// failure; empty if it holds.
namespace calotte::mesh_detail {

inline std::string shape_failure(const Mesh& mesh) {
  if (mesh.triangles.cols() == 0)
    return "the mesh has no triangle";
  if (mesh.triangles.cols() > std::numeric_limits<std::int32_t>::max())
    return message("the mesh has {} triangles: 32-bit neighbours allow 2^31 - 1 at most",
                   mesh.triangles.cols());
  if (mesh.neighbours.cols() != mesh.triangles.cols())
    return message("the mesh has {} triangles but neighbours of {}", mesh.triangles.cols(),
                   mesh.neighbours.cols());
  const std::int64_t n = mesh.points.cols();
  for (std::size_t i = 0; i < mesh.site_of_input.size(); ++i)
    if (mesh.site_of_input[i] < 0 || mesh.site_of_input[i] >= n)
      return message("input {} is said to be site {} of {}", i, mesh.site_of_input[i], n);
  return {};
}

inline std::string id_failure(const Faces& s, std::int64_t t) {
  for (int i = 0; i < 3; ++i) {
    if (s.vertex(t, i) < 0 || s.vertex(t, i) >= s.sites())
      return message("{} has a vertex outside 0 to {}", triangle_name(s, t), s.sites() - 1);
    if (s.neighbour(t, i) < -1 || s.neighbour(t, i) >= s.triangles())
      return message("{} has the neighbour {}, outside -1 to {}", triangle_name(s, t),
                     s.neighbour(t, i), s.triangles() - 1);
  }
  return {};
}

inline std::string order_failure(const Faces& s, std::int64_t t) {
  const auto vertices = [&](std::int64_t of) {
    return std::array<std::int32_t, 3>{s.vertex(of, 0), s.vertex(of, 1), s.vertex(of, 2)};
  };
  const std::array<std::int32_t, 3> own = vertices(t);
  if (own[0] == own[1] || own[1] == own[2] || own[2] == own[0])
    return triangle_name(s, t) + " has a vertex twice";
  if (own[0] > own[1] || own[0] > own[2])
    return triangle_name(s, t) + " does not start at its lowest vertex";
  if (t > 0 && vertices(t - 1) == own)
    return triangle_name(s, t) + " is there twice";
  if (t > 0 && vertices(t - 1) > own)
    return triangle_name(s, t) + " is not in the order of the vertices";
  return {};
}

/// The failure at the edge across from vertex i.
inline std::string neighbour_failure(const Faces& s, std::int64_t t, int i) {
  const std::int32_t other = s.neighbour(t, i);
  if (other < 0)
    return {};
  const int start = slot_of(s, other, s.vertex(t, i + 2));
  if (start == 3 || s.vertex(other, start + 1) != s.vertex(t, i + 1))
    return message("{} is not an edge of its neighbour, {}", edge_name(s, t, i),
                   triangle_name(s, other));
  if (s.neighbour(other, start + 2) != t)
    return message("{}: its neighbour, {}, has another there", edge_name(s, t, i),
                   triangle_name(s, other));
  return {};
}

} // namespace calotte::mesh_detail
