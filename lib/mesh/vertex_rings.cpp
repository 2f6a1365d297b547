// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_rings.h"

#include "base/parallel.h"

#include <atomic>
#include <span>

namespace calotte::mesh_detail {
namespace {

/// For each of the first sites a corner at it. The choice may vary; the order of the rings does not
/// depend on it.
Array<Corner> some_corners(const Faces& mesh) {
  Array<Corner> corner(mesh.sites());
  for_each_block(mesh.triangles(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      for (int v = 0; v < 3; ++v)
        if (const std::int32_t site = mesh.triangle_ids(v, t); site < mesh.sites())
          std::atomic_ref(corner[site])
              .store({static_cast<std::int32_t>(t), v}, std::memory_order_relaxed);
  });
  return corner;
}

} // namespace

Array<Corner> ring_starts(const Faces& mesh, Array<std::int64_t>* degrees) {
  Array<Corner> first = some_corners(mesh);
  for_each_block(mesh.sites(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      std::int64_t count = 0;
      Corner lowest = first[i];
      walk_around(mesh, first[i], [&](Corner corner) {
        ++count;
        if (following_site(mesh, corner) < following_site(mesh, lowest))
          lowest = corner;
      });
      first[i] = lowest;
      if (degrees != nullptr)
        (*degrees)[i] = count;
    }
  });
  return first;
}

void gather_ring(const Faces& mesh, Corner start, std::vector<Corner>& ring) {
  ring.clear();
  walk_around(mesh, start, [&](Corner corner) { ring.push_back(corner); });
}

VertexRings make_vertex_rings(const Mesh& mesh) {
  return make_vertex_rings(mesh.triangles, mesh.neighbours, mesh.points.cols());
}

VertexRings make_vertex_rings(const Triangles& triangles, const Triangles& neighbours,
                              std::int64_t sites) {
  const Faces mesh{triangles, neighbours, sites};
  const std::int64_t n = sites;
  VertexRings rings{Array<std::int64_t>(n + 1), {}};
  const Array<Corner> first = ring_starts(mesh, &rings.begin);
  rings.begin[n] = 0;
  exclusive_scan(std::span(rings.begin.begin(), rings.begin.end()));
  rings.items = Array<Corner>(rings.begin[n]);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      std::int64_t at = rings.begin[i];
      walk_around(mesh, first[i], [&](Corner corner) { rings.items[at++] = corner; });
    }
  });
  return rings;
}

} // namespace calotte::mesh_detail
