// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/loops.h"

#include "domain/arc_tree.h"
#include "domain/rings.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace calotte::domain_detail {
namespace {

/// Marks the corners after `first` to `last`, both indices modulo the ring's size.
/// \returns false, and marks none, if one of them or a corner beside them is marked.
bool mark(std::int64_t first, std::int64_t last, std::vector<bool>& marked) {
  const std::int64_t n = std::ssize(marked);
  for (std::int64_t i = first; i <= last + 1; ++i)
    if (marked[static_cast<std::size_t>(i % n)])
      return false;
  for (std::int64_t i = first + 1; i <= last; ++i)
    marked[static_cast<std::size_t>(i % n)] = true;
  return true;
}

/// The corners of loops between arcs that meet; empty if a loop is too long.
std::vector<bool> corners_of_loops(std::int64_t n,
                                   const std::vector<std::pair<std::int32_t, std::int32_t>>& met) {
  const std::int64_t most = std::max<std::int64_t>(n / 10, 1);
  std::vector<bool> marked(static_cast<std::size_t>(n));
  for (const auto& [e, f] : met) {
    const std::int64_t low = std::min(e, f), high = std::max(e, f), between = high - low;
    if (std::min(between, n - between) > most)
      return {};
    if (between <= n - between)
      mark(low, high, marked);
    else
      mark(high, low + n, marked);
  }
  return marked;
}

/// The corners that are not marked, without those that now repeat their neighbour.
Points3 others(const Points3& ring, const std::vector<bool>& marked) {
  Points3 result(3, ring.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < ring.cols(); ++i)
    if (!marked[static_cast<std::size_t>(i)] &&
        (count == 0 || ring.col(i) != result.col(count - 1)))
      result.col(count++) = ring.col(i);
  while (count > 1 && result.col(count - 1) == result.col(0))
    --count;
  result.conservativeResize(Eigen::NoChange, count);
  return result;
}

} // namespace

Points3 without_loops(const Points3& ring) {
  Points3 result = ring;
  while (true) {
    const Rings rings = rings_of({result});
    const auto met = meetings(rings, ArcTree(rings.arcs.items));
    if (met.empty())
      return result;
    const std::vector<bool> leave = corners_of_loops(result.cols(), met);
    if (leave.empty())
      return ring;
    result = others(result, leave);
  }
}

} // namespace calotte::domain_detail
