// SPDX-License-Identifier: GPL-3.0-or-later
#include "sites.h"

#include "curve.h"
#include "order.h"
#include "predicates.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

namespace calotte::detail {
namespace {

constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();

bool is_finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
bool is_zero(const Vec3& p) { return p.x == 0 && p.y == 0 && p.z == 0; }

[[noreturn]] void refuse(const Points3& points, std::int64_t i) {
  const std::string name = "point " + std::to_string(i);
  if (is_zero(column(points, i)))
    throw Error(ErrorCode::zero_vector,
                name + " is the zero vector: remove it, it has no direction", i);
  throw Error(ErrorCode::not_finite, name + " has a coordinate that is NaN or infinite: remove it",
              i);
}

/// Curve keys of all inputs, which it checks.
Array<KeyedIndex> make_entries(const Points3& points) {
  const std::int64_t n = points.cols();
  Array<KeyedIndex> entries(n);
  std::vector<std::int64_t> offending(static_cast<std::size_t>(block_count(n)), none);
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = end - 1; i >= begin; --i) {
      const Vec3& p = column(points, i);
      if (!is_finite(p) || is_zero(p)) {
        offending[static_cast<std::size_t>(block)] = i;
        continue;
      }
      entries[i] = {curve_key(to_cube(p)), static_cast<std::int32_t>(i)};
    }
  });
  const auto first = std::min_element(offending.begin(), offending.end());
  if (first != offending.end() && *first != none)
    refuse(points, *first);
  return entries;
}

/// Orders a run of equal keys: along a curve over the square that its cube points fill, and so on
/// where those keys are equal too. A cluster narrower than a finest cell is a curve like any other
/// then, where walks from site to site are short. Equal cube points end up side by side, ordered by
/// direction, then index.
void order_finely(const Points3& points, KeyedIndex* begin, KeyedIndex* end) {
  const auto cube_point = [&](const KeyedIndex& e) { return to_cube(column(points, e.index)); };
  CubePoint low = cube_point(*begin), high = low;
  for (const KeyedIndex* e = begin; e != end; ++e) {
    const CubePoint p = cube_point(*e);
    low = {p.face, std::min(low.u, p.u), std::min(low.v, p.v)};
    high = {p.face, std::max(high.u, p.u), std::max(high.v, p.v)};
  }
  const double width = std::max(high.u - low.u, high.v - low.v);
  if (width == 0) {
    std::sort(begin, end, [&](const KeyedIndex& a, const KeyedIndex& b) {
      const Vec3 &p = column(points, a.index), &q = column(points, b.index);
      const bool equal_bits = p.x == q.x && p.y == q.y && p.z == q.z; // spares exact arithmetic
      const int order = equal_bits ? 0 : compare_directions(p, q);
      return order != 0 ? order < 0 : a.index < b.index;
    });
    return;
  }
  std::vector<KeyedIndex> finer(begin, end);
  for (KeyedIndex& e : finer) {
    const CubePoint p = cube_point(e);
    const double u = (p.u - low.u) / width, v = (p.v - low.v) / width;
    e.key = curve_key({p.face, 2 * u - 1, 2 * v - 1});
  }
  std::sort(finer.begin(), finer.end(), precedes);
  for (std::size_t i = 0; i < finer.size(); ++i)
    begin[i].index = finer[i].index;
  for (std::size_t i = 0, last = 0; i < finer.size(); i = last) {
    while (last < finer.size() && finer[last].key == finer[i].key)
      ++last;
    if (last - i > 1)
      order_finely(points, begin + i, begin + last);
  }
}

/// For each input the lowest index of the same direction. Equal directions have the same bits on
/// the cube, hence the same key, and stand side by side in a run of equal keys that is in order.
void link_duplicates(const Points3& points, KeyedIndex* begin, KeyedIndex* end,
                     std::vector<std::int32_t>& lowest) {
  order_finely(points, begin, end);
  for (KeyedIndex* e = begin + 1; e < end; ++e)
    if (same_direction(column(points, e[-1].index), column(points, e->index)))
      lowest[static_cast<std::size_t>(e->index)] = lowest[static_cast<std::size_t>(e[-1].index)];
}

/// Merges each input into an earlier one that stays and is nearer than `within` radians, if there
/// is one: those that stay are kept in a grid of cubes no smaller than the distance.
void link_near(const Points3& points, double within, std::vector<std::int32_t>& lowest) {
  const double chord = 2 * std::sin(std::min(within, 3.141592653589793) / 2);
  const double cell = std::max(chord, 0x1p-50); // unit vectors are not closer than some of these
  std::unordered_multimap<std::uint64_t, std::int32_t> grid;
  const auto cell_of = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell)); };
  // Cubes that share a hash cost time alone: distances are compared.
  const auto hash = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    std::uint64_t h = 0;
    for (const std::int64_t index : {i, j, k})
      h = (h ^ h >> 32 ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15U;
    return h;
  };
  const auto nearest_kept = [&](const Vec3& p) {
    std::int64_t best = none;
    for (std::int64_t i = cell_of(p.x) - 1; i <= cell_of(p.x) + 1; ++i)
      for (std::int64_t j = cell_of(p.y) - 1; j <= cell_of(p.y) + 1; ++j)
        for (std::int64_t k = cell_of(p.z) - 1; k <= cell_of(p.z) + 1; ++k) {
          const auto [first, last] = grid.equal_range(hash(i, j, k));
          for (auto it = first; it != last; ++it)
            if (norm(p - normalised(column(points, it->second))) < chord)
              best = std::min<std::int64_t>(best, it->second);
        }
    return best;
  };
  for (std::int64_t i = 0; i < points.cols(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    if (lowest[index] != i) { // its twin came earlier and knows by now where it went
      lowest[index] = lowest[static_cast<std::size_t>(lowest[index])];
      continue;
    }
    const Vec3 p = normalised(column(points, i));
    if (const std::int64_t kept = nearest_kept(p); kept != none)
      lowest[index] = static_cast<std::int32_t>(kept);
    else
      grid.emplace(hash(cell_of(p.x), cell_of(p.y), cell_of(p.z)), static_cast<std::int32_t>(i));
  }
}

/// For each input the one that stands for it; empty when each stands for itself.
std::vector<std::int32_t> link_inputs(const Points3& points, Array<KeyedIndex>& entries,
                                      double merge_within) {
  const std::int64_t n = entries.size();
  std::vector<std::pair<std::int64_t, std::int64_t>> runs; // of equal keys
  std::vector<std::vector<std::pair<std::int64_t, std::int64_t>>> found(
      static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      if (i + 1 == n || entries[i].key != entries[i + 1].key)
        continue;
      if (i > 0 && entries[i - 1].key == entries[i].key)
        continue;
      std::int64_t last = i + 2;
      while (last != n && entries[last].key == entries[i].key)
        ++last;
      found[static_cast<std::size_t>(block)].emplace_back(i, last);
    }
  });
  for (const auto& list : found)
    runs.insert(runs.end(), list.begin(), list.end());
  if (runs.empty() && merge_within == 0)
    return {};

  std::vector<std::int32_t> lowest(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < lowest.size(); ++i)
    lowest[i] = static_cast<std::int32_t>(i);
  for_each_task(static_cast<std::int64_t>(runs.size()), [&](std::int64_t r) {
    const auto [begin, end] = runs[static_cast<std::size_t>(r)];
    link_duplicates(points, entries.begin() + begin, entries.begin() + end, lowest);
  });
  if (merge_within > 0)
    link_near(points, merge_within, lowest);
  return lowest;
}

void refuse_duplicates(const std::vector<std::int32_t>& lowest) {
  for (std::size_t i = 0; i < lowest.size(); ++i)
    if (static_cast<std::size_t>(lowest[i]) != i)
      throw Error(ErrorCode::duplicate,
                  "point " + std::to_string(i) + " has the direction of point " +
                      std::to_string(lowest[i]) + ": remove it, or let duplicates be merged",
                  static_cast<std::int64_t>(i));
}

/// Keeps the entries that stand for themselves and numbers them in the order of the input.
void keep_distinct(const Points3& points, const std::vector<std::int32_t>& lowest,
                   Array<KeyedIndex>& entries, Sites& sites) {
  std::int32_t kept = 0;
  for (std::size_t i = 0; i < lowest.size(); ++i)
    sites.site_of_input[i] = static_cast<std::size_t>(lowest[i]) == i
                                 ? kept++
                                 : sites.site_of_input[static_cast<std::size_t>(lowest[i])];
  sites.points.resize(3, kept);
  for (std::size_t i = 0; i < lowest.size(); ++i)
    if (static_cast<std::size_t>(lowest[i]) == i)
      sites.points.col(sites.site_of_input[i]) = points.col(static_cast<Eigen::Index>(i));
  Array<KeyedIndex> distinct(kept);
  std::int64_t next = 0;
  for (const KeyedIndex& e : entries)
    if (lowest[static_cast<std::size_t>(e.index)] == e.index)
      distinct[next++] = {e.key, sites.site_of_input[static_cast<std::size_t>(e.index)]};
  entries = std::move(distinct);
}

void copy_all(const Points3& points, Sites& sites) {
  sites.points.resize(3, points.cols());
  prefer_huge_pages(sites.points.data(), 24 * static_cast<std::size_t>(points.cols()));
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    sites.points.middleCols(begin, end - begin) = points.middleCols(begin, end - begin);
    for (std::int64_t i = begin; i != end; ++i)
      sites.site_of_input[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(i);
  });
}

void require_count(std::int64_t n, const char* kind) {
  if (n < 4)
    throw Error(ErrorCode::too_few_sites, "there are " + std::to_string(n) + " " + kind +
                                              ": a triangulation of the sphere needs at least 4");
  if (n > std::int64_t{1} << 30)
    throw Error(ErrorCode::bad_option, "there are " + std::to_string(n) +
                                           " points: 32-bit triangle ids allow 2^30 at most");
}

} // namespace

Sites make_sites(const Points3& points, Duplicates duplicates, double merge_within) {
  if (!(merge_within >= 0) || !std::isfinite(merge_within))
    throw Error(ErrorCode::bad_option, "the angle to merge within is " +
                                           std::to_string(merge_within) +
                                           "; give 0 radians or more");
  require_count(points.cols(), "points");
  Array<KeyedIndex> entries = make_entries(points);
  sort_by_key(entries);
  const std::vector<std::int32_t> lowest = link_inputs(points, entries, merge_within);
  if (duplicates == Duplicates::refuse)
    refuse_duplicates(lowest);

  Sites sites;
  sites.site_of_input.resize(static_cast<std::size_t>(points.cols()));
  if (lowest.empty())
    copy_all(points, sites);
  else
    keep_distinct(points, lowest, entries, sites);
  const std::int64_t n = entries.size();
  require_count(n, "distinct directions");
  sites.id = Array<std::int32_t>(n);
  sites.unit = Array<Vec3>(n);
  Array<std::uint64_t> keys(n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t rank = begin; rank != end; ++rank) {
      sites.id[rank] = entries[rank].index;
      keys[rank] = entries[rank].key;
      sites.unit[rank] = normalised(sites.given(entries[rank].index));
    }
  });
  sites.cells = CellTree(std::move(keys));
  return sites;
}

} // namespace calotte::detail
