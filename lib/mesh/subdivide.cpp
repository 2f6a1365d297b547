// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/subdivide.h"

#include "base/array.h"
#include "base/parallel.h"
#include "base/triangle.h"
#include "mesh/edges.h"

#include <span>

namespace calotte::mesh_detail {
namespace {

struct Coarse {
  const Triangles& triangles;
  const Triangles& neighbours;
  std::int64_t points;

  std::int64_t size() const { return triangles.cols(); }
};

/// By triangle, the number of edges before the first of its own.
Array<std::int32_t> first_edges(const Coarse& mesh) {
  Array<std::int32_t> first(mesh.size());
  for_each_block(mesh.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      first[t] = is_first(mesh, t, 0) + is_first(mesh, t, 1) + is_first(mesh, t, 2);
  });
  exclusive_scan(std::span(first.begin(), first.end()));
  return first;
}

/// The index of the edge across from vertex i in the triangle beyond it.
int index_beyond(const Coarse& mesh, std::int64_t t, int i) {
  const std::int32_t beyond = mesh.neighbours(i, t), start = mesh.triangles(previous_vertex(i), t);
  const auto is_there = [&](int k) {
    return mesh.neighbours(k, beyond) == t && mesh.triangles(next_vertex(k), beyond) == start;
  };
  return is_there(0) ? 0 : is_there(1) ? 1 : 2;
}

/// The vertex that is the midpoint of the edge across from vertex i.
std::int32_t midpoint(const Coarse& mesh, const Array<std::int32_t>& first, std::int64_t t, int i) {
  if (!is_first(mesh, t, i)) {
    return midpoint(mesh, first, mesh.neighbours(i, t), index_beyond(mesh, t, i));
  }
  std::int64_t edge = first[t];
  for (int before = 0; before != i; ++before)
    edge += is_first(mesh, t, before);
  return static_cast<std::int32_t>(mesh.points + edge);
}

/// The part beyond the edge across from vertex i that is at the edge's start, or at its end, as
/// seen from triangle t.
std::int32_t part_beyond(const Coarse& mesh, std::int64_t t, int i, bool start) {
  const std::int32_t beyond = mesh.neighbours(i, t);
  if (beyond < 0)
    return -1;
  const int there = index_beyond(mesh, t, i);
  return 4 * beyond + (start ? previous_vertex(there) : next_vertex(there));
}

void cut(const Coarse& mesh, const Array<std::int32_t>& first, std::int64_t t, Connectivity& out) {
  const std::int32_t m[3] = {midpoint(mesh, first, t, 0), midpoint(mesh, first, t, 1),
                             midpoint(mesh, first, t, 2)};
  const auto middle = static_cast<std::int32_t>(4 * t + 3);
  for (int i = 0; i < 3; ++i) {
    const int next = next_vertex(i), previous = previous_vertex(i);
    out.triangles.col(4 * t + i) << mesh.triangles(i, t), m[previous], m[next];
    out.neighbours.col(4 * t + i) << middle, part_beyond(mesh, t, next, false),
        part_beyond(mesh, t, previous, true);
  }
  out.triangles.col(middle) << m[0], m[1], m[2];
  out.neighbours.col(middle) << middle - 3, middle - 2, middle - 1;
}

} // namespace

Connectivity subdivided(const Triangles& triangles, const Triangles& neighbours,
                        std::int64_t points) {
  const Coarse mesh{triangles, neighbours, points};
  const Array<std::int32_t> first = first_edges(mesh);
  Connectivity out;
  out.triangles.resize(3, 4 * mesh.size());
  out.neighbours.resize(3, 4 * mesh.size());
  for_each_block(mesh.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      cut(mesh, first, t, out);
  });
  return out;
}

} // namespace calotte::mesh_detail
