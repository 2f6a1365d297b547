// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/orientation.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "exact/space.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace calotte::mesh_detail {
namespace {

void join(Orientations& all, const Orientations& block) {
  if (all.first_counter_clockwise < 0)
    all.first_counter_clockwise = block.first_counter_clockwise;
  if (all.first_clockwise < 0)
    all.first_clockwise = block.first_clockwise;
  all.counter_clockwise += block.counter_clockwise;
  all.clockwise += block.clockwise;
}

/// Counts orientations. \param sign(a, b, c) orientation of three vertices.
template <class Sign> Orientations tally(const Triangles& triangles, const Sign& sign) {
  std::vector<Orientations> blocks(static_cast<std::size_t>(block_count(triangles.cols())));
  for_each_block(triangles.cols(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Orientations& found = blocks[static_cast<std::size_t>(block)];
    for (std::int64_t t = begin; t != end; ++t) {
      const int way = sign(triangles(0, t), triangles(1, t), triangles(2, t));
      if (way > 0 && found.counter_clockwise++ == 0)
        found.first_counter_clockwise = t;
      if (way < 0 && found.clockwise++ == 0)
        found.first_clockwise = t;
    }
  });
  Orientations all;
  for (const Orientations& block : blocks)
    join(all, block);
  return all;
}

/// A side of a triangle without a neighbour.
struct OpenSide {
  std::int32_t lower, higher;
  std::int64_t triangle;
  std::int32_t from, to;

  bool operator<(const OpenSide& other) const {
    return std::tie(lower, higher, triangle) < std::tie(other.lower, other.higher, other.triangle);
  }
  bool same_edge(const OpenSide& other) const {
    return lower == other.lower && higher == other.higher;
  }
};

std::vector<OpenSide> open_sides(const Triangles& triangles, const Triangles& neighbours) {
  std::vector<OpenSide> sides;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (neighbours(i, t) < 0) {
        const std::int32_t from = triangles(next_vertex(i), t),
                           to = triangles(previous_vertex(i), t);
        sides.push_back({std::min(from, to), std::max(from, to), t, from, to});
      }
  return sides;
}

} // namespace

Orientations orientations_of(const Points3& points, const Triangles& triangles,
                             const Surface& surface) {
  return in_space_of(surface, [&](const Space auto& space) {
    return tally(triangles, [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      const auto p = space.position(column(points, a));
      return space.orientation(p, space.near(column(points, b), p),
                               space.near(column(points, c), p));
    });
  });
}

void reverse(Triangles& triangles) {
  for_each_block(triangles.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      std::swap(triangles(1, t), triangles(2, t));
  });
}

SharedEdge first_shared_edge(const Triangles& triangles, const Triangles& neighbours) {
  std::vector<OpenSide> sides = open_sides(triangles, neighbours);
  std::sort(sides.begin(), sides.end());
  SharedEdge first;
  for (std::size_t k = 1; k < sides.size(); ++k)
    if (sides[k].same_edge(sides[k - 1]) &&
        (first.triangle < 0 || sides[k - 1].triangle < first.triangle))
      first = {sides[k - 1].triangle, sides[k - 1].from, sides[k - 1].to};
  return first;
}

} // namespace calotte::mesh_detail
