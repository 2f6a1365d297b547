// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "base/parallel.h"
#include "exact/predicates.h"
#include "mesh/faces.h"
#include "mesh/failures.h"

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

/// The laws of the geometry: orientation, empty circles, Euler's characteristic and areas.
/// check_laws.h describes Surface.
namespace calotte::mesh_detail {

template <class Surface> std::string orientation_failure(const Surface& s, std::int64_t t) {
  if (s.orientation(s.vertex(t, 0), s.vertex(t, 1), s.vertex(t, 2)) > 0)
    return {};
  return triangle_name(s, t) + " is not counter-clockwise";
}

/// Tests the edge across from vertex i, from the triangle of the lower number.
template <class Surface> std::string edge_failure(const Surface& s, std::int64_t t, int i) {
  const std::int32_t other = s.neighbour(t, i);
  if (other < t) // no neighbour, or tested from there
    return {};
  const std::int32_t across = s.vertex(other, slot_of(s, other, s.vertex(t, i + 2)) + 2);
  if (s.in_circle(s.vertex(t, i + 1), s.vertex(t, i + 2), s.vertex(t, i), across) < 0)
    return {};
  return message("{} is not Delaunay: site {} is inside the circum{}", edge_name(s, t, i), across,
                 Surface::circle);
}

template <class Surface> std::string euler_failure(const Surface& s, std::int64_t boundary_edges) {
  const std::int64_t edges = (3 * s.triangles() + boundary_edges) / 2;
  const std::int64_t euler = s.sites() - edges + s.triangles();
  const std::int64_t expected = s.euler(boundary_edges);
  if (euler == expected)
    return {};
  return message("Euler's characteristic is {} instead of {}", euler, expected);
}

struct Area {
  double value = 0, error = 0;
};

/// The area of some triangles, summed one after the other.
struct AreaSum {
  Area area;
  std::int64_t count = 0;

  void add(const Area& more) {
    area.value += more.value;
    area.error += more.error;
    ++count;
  }
};

/// Blocks are summed apart, so that the rounding of the sums stays within (block size + blocks) u.
inline Area total_of(const std::vector<AreaSum>& blocks) {
  Area total;
  for (const AreaSum& block : blocks) {
    total.value += block.area.value;
    total.error +=
        block.area.error + static_cast<double>(block.count) * roundoff * block.area.value;
  }
  total.error += static_cast<double>(blocks.size()) * roundoff * total.value;
  return total;
}

template <class Surface> Area sum_areas(const Surface& s) {
  std::vector<AreaSum> sums(static_cast<std::size_t>(block_count(s.triangles())));
  for_each_block(s.triangles(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    AreaSum& sum = sums[static_cast<std::size_t>(block)];
    for (std::int64_t t = begin; t != end; ++t)
      sum.add(s.area(t));
  });
  return total_of(sums);
}

inline std::int64_t count_boundary_edges(const Triangles& neighbours) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(block_count(neighbours.cols())));
  for_each_block(neighbours.cols(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    counts[static_cast<std::size_t>(block)] =
        (neighbours.middleCols(begin, end - begin).array() < 0).count();
  });
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

} // namespace calotte::mesh_detail
