// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "mesh/boundary_loops.h"
#include "mesh/faces.h"

#include <calotte/check.h>

#include <algorithm>
#include <cstdint>
#include <vector>

/// Counts the edges of a mesh that need be neither Delaunay nor convex. check_laws.h describes
/// Surface, which here also knows
///   relative_length(a, b, c, d)  the length of the Voronoi edge of ab over that of ab itself, for
///                                triangles abc and bad.
namespace calotte::mesh_detail {

inline void join(EdgeCounts& all, const EdgeCounts& block) {
  all.edges += block.edges;
  all.boundary += block.boundary;
  all.not_delaunay += block.not_delaunay;
  all.cocircular += block.cocircular;
  all.shortest = std::min(all.shortest, block.shortest);
  if (all.first[0] < 0)
    all.first = block.first;
}

/// Counts the edge across from vertex i, at its triangle of the lower number.
template <class Surface>
void count_edge(const Surface& s, std::int64_t t, int i, EdgeCounts& counts) {
  constexpr double rounding = 1e-9;
  const std::int32_t other = s.neighbour(t, i);
  if (other >= 0 && other < t)
    return;
  ++counts.edges;
  if (other < 0) {
    ++counts.boundary;
    return;
  }
  const std::int32_t a = s.vertex(t, i + 1), b = s.vertex(t, i + 2), c = s.vertex(t, i);
  const std::int32_t d = s.vertex(other, slot_of(s, other, b) + 2);
  if (s.in_circle(a, b, c, d) < 0) // d is outside
    return;
  const double length = s.relative_length(a, b, c, d);
  if (length > -rounding) {
    ++counts.cocircular;
    return;
  }
  if (counts.not_delaunay++ == 0)
    counts.first = {std::min(a, b), std::max(a, b)};
  counts.shortest = std::min(counts.shortest, length);
}

template <class Surface> void count_boundary(const Surface& s, EdgeCounts& counts) {
  const EdgeLoops loops = edge_loops(s);
  counts.loops += loops.size();
  for (std::int64_t k = 0; k < loops.size(); ++k) {
    std::int64_t last = loops[k].back();
    for (const std::int64_t edge : loops[k]) {
      counts.not_convex +=
          s.orientation(start_of(s, last), start_of(s, edge), end_of(s, edge)) < 0 ? 1 : 0;
      last = edge;
    }
  }
}

inline std::int64_t count_unused_sites(const Faces& s) {
  std::vector<bool> used(static_cast<std::size_t>(s.sites()));
  for (std::int64_t t = 0; t < s.triangles(); ++t)
    for (int i = 0; i < 3; ++i)
      used[static_cast<std::size_t>(s.vertex(t, i))] = true;
  return std::count(used.begin(), used.end(), false);
}

template <class Surface> EdgeCounts count_edges_of(const Surface& s) {
  std::vector<EdgeCounts> blocks(static_cast<std::size_t>(block_count(s.triangles())));
  for_each_block(s.triangles(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      for (int i = 0; i < 3; ++i)
        count_edge(s, t, i, blocks[static_cast<std::size_t>(block)]);
  });
  EdgeCounts all;
  for (const EdgeCounts& block : blocks)
    join(all, block);
  if (all.boundary > 0)
    count_boundary(s, all);
  all.unused_sites = count_unused_sites(s);
  return all;
}

} // namespace calotte::mesh_detail
