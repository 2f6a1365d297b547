// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/monitor.h"
#include "base/parallel.h"
#include "curve/traversal.h"
#include "mesh/array_laws.h"
#include "mesh/shape_laws.h"

#include <calotte/check.h>

#include <cstdint>
#include <vector>

/// Checks all laws of a closed mesh in one pass over its triangles.
namespace calotte::mesh_detail {

/// The results of a block's triangles. Each triangle contributes itself and its edges to triangles
/// of higher numbers.
struct Tally {
  bool good = true;
  std::int64_t up = 0, down = 0; ///< neighbours of higher and of lower numbers
  AreaSum sum;
};

/// Prefetches the data that the laws of a triangle read: otherwise each read from a distant part of
/// a large mesh would wait for the one before it.
inline void fetch_triangle(const Faces& s, std::int64_t t) {
  __builtin_prefetch(&s.triangle_ids(0, t));
  __builtin_prefetch(&s.neighbour_ids(0, t));
}

/// The same for its vertices and the neighbours that it tests.
template <class Surface> void fetch_neighbours(const Surface& s, std::int64_t t) {
  for (int i = 0; i < 3; ++i) {
    __builtin_prefetch(s.stored(s.vertex(t, i)));
    if (const std::int32_t other = s.neighbour(t, i); other > t)
      fetch_triangle(s, other);
  }
}

/// The same for the vertices of these neighbours.
template <class Surface> void fetch_across(const Surface& s, std::int64_t t) {
  for (int i = 0; i < 3; ++i)
    if (const std::int32_t other = s.neighbour(t, i); other > t)
      for (int j = 0; j < 3; ++j)
        __builtin_prefetch(s.stored(s.vertex(other, j)));
}

template <class Surface> bool tally(const Surface& s, std::int64_t t, Tally& tally) {
  if (!order_failure(s, t).empty() || !s.own_failure(t).empty() ||
      !orientation_failure(s, t).empty())
    return false;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t other = s.neighbour(t, i);
    if (other < 0)
      return false;
    if (other < t) {
      ++tally.down;
      continue;
    }
    ++tally.up;
    if (!neighbour_failure(s, t, i).empty() || !edge_failure(s, t, i).empty())
      return false;
  }
  tally.sum.add(s.area(t));
  return true;
}

template <class Surface>
Tally tally_block(const Surface& s, const Traversal& way, std::int64_t begin, std::int64_t end) {
  constexpr std::int64_t ahead = 16;
  Tally out;
  for (std::int64_t i = begin; i != end && out.good; ++i) {
    if (i + 3 * ahead < end)
      fetch_triangle(s, way[i + 3 * ahead]);
    if (i + 2 * ahead < end)
      fetch_neighbours(s, way[i + 2 * ahead]);
    if (i + ahead < end)
      fetch_across(s, way[i + ahead]);
    out.good = tally(s, way[i], out);
  }
  return out;
}

template <class Surface> Traversal order_traversal(const Surface& s) {
  if (!are_scattered(s.neighbour_ids))
    return {};
  return {s.triangles(), s.sites(), Surface::cube_faces,
          [&](std::int64_t t) { return s.square(s.vertex(t, 0)); }};
}

/// True if all laws hold for a closed mesh, whose ids are in range.
/// \param result its areas are set if they hold.
///
/// Each triangle is visited once, in any order: its laws read it, its predecessor in number and its
/// neighbours; the other laws are counts and sums.
///
/// An edge is tested from one side only. Each side that points to a higher number is known to be
/// answered by one that points back, and no two are answered by the same. If as many sides point to
/// lower numbers, neighbours are therefore mutual.
///
/// Walks around the sites are not needed. Glued along their edges, the triangles, all
/// counter-clockwise, cover the sphere or the periodic box evenly, except for branch points at
/// sites around which they turn more than once; the number of sheets is the sum of their areas
/// divided by the whole. If that is less than 3/2, there is one sheet: the surface has the shape of
/// the whole, and no point is covered twice. The triangles at a site are then a single cycle that
/// turns around it once, and by Euler's characteristic there are as many cycles as sites. The sum
/// is below that bound if it is the whole within its error, and this error is small.
template <class Surface>
bool is_proven_closed(const Surface& s, CheckReport& result, Monitor& monitor) {
  std::vector<Tally> tallies(static_cast<std::size_t>(block_count(s.triangles())));
  const Traversal way = order_traversal(s);
  for_each_block(s.triangles(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    tallies[static_cast<std::size_t>(block)] = tally_block(s, way, begin, end);
    monitor.step();
  });
  Tally all;
  std::vector<AreaSum> sums;
  for (const Tally& block : tallies) {
    all.good = all.good && block.good;
    all.up += block.up;
    all.down += block.down;
    sums.push_back(block.sum);
  }
  if (!all.good || all.up != all.down || !euler_failure(s, 0).empty())
    return false;
  const Area total = total_of(sums);
  CheckReport proven = result;
  s.set_area(total.value, proven);
  if (total.error >= total.value / 16 || !s.area_failure(total, proven).empty())
    return false;
  result = proven;
  return true;
}

} // namespace calotte::mesh_detail
