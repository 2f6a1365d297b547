// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "base/split_mix.h"
#include "curve/hilbert.h"
#include "curve/radix_sort.h"
#include "delaunay/site_inputs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

/// Duplicate inputs: equal ones, and those nearer than a distance.
namespace calotte::delaunay_detail {

/// Orders a run of inputs of equal keys along a curve over the square that their cube points fill,
/// and recursively if keys are equal again. A cluster narrower than a finest cell thus follows a
/// curve, too, on which walks from site to site are short. Equal cube points become adjacent,
/// ordered by direction, then index.
template <class Input> void order_finely(const Input& input, std::span<std::int32_t> run) {
  CubePoint low = input.square(run.front()), high = low;
  for (const std::int32_t i : run) {
    const CubePoint p = input.square(i);
    low = {p.face, std::min(low.u, p.u), std::min(low.v, p.v)};
    high = {p.face, std::max(high.u, p.u), std::max(high.v, p.v)};
  }
  const double width = std::max(high.u - low.u, high.v - low.v);
  if (width == 0) {
    std::sort(run.begin(), run.end(), [&](std::int32_t a, std::int32_t b) {
      const int order = input.compare(a, b);
      return order != 0 ? order < 0 : a < b;
    });
    return;
  }
  std::vector<KeyedItem> finer;
  finer.reserve(run.size());
  for (const std::int32_t i : run) {
    const CubePoint p = input.square(i);
    const double u = (p.u - low.u) / width, v = (p.v - low.v) / width;
    finer.push_back({curve_key({p.face, 2 * u - 1, 2 * v - 1}), i});
  }
  std::sort(finer.begin(), finer.end(), precedes);
  for (std::size_t i = 0; i < finer.size(); ++i)
    run[i] = finer[i].item;
  for (std::size_t i = 0, last = 0; i < finer.size(); i = last) {
    while (last < finer.size() && finer[last].key == finer[i].key)
      ++last;
    if (last - i > 1)
      order_finely(input, run.subspan(i, last - i));
  }
}

/// Links each input to the lowest index of the same direction. Equal directions have the same bits
/// on the cube, hence the same key, and are adjacent in an ordered run of equal keys.
template <class Input>
void link_duplicates(const Input& input, std::span<std::int32_t> run,
                     std::vector<std::int32_t>& lowest) {
  order_finely(input, run);
  for (std::size_t i = 1; i < run.size(); ++i)
    if (input.same(run[i - 1], run[i]))
      lowest[static_cast<std::size_t>(run[i])] = lowest[static_cast<std::size_t>(run[i - 1])];
}

/// Merges each input into an earlier input that stays and is nearer than `within`, if there is one.
/// The inputs that stay are in a grid of cubes wider than the distance, including rounding.
template <class Input>
void link_near(const Input& input, double within, std::vector<std::int32_t>& lowest) {
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  const double cell = (1 + 1e-9) * input.distance(within) + 0x1p-48;
  std::unordered_multimap<std::uint64_t, std::int32_t> grid;
  const auto cell_of = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell)); };
  // A collision of hashes costs time only, because distances are compared.
  const auto hash = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    std::uint64_t h = 0;
    for (const std::int64_t index : {i, j, k})
      h = hash_with(h, static_cast<std::uint64_t>(index));
    return h;
  };
  const auto lowest_kept = [&](std::int64_t candidate) {
    const Vec3 p = input.unit(input.at(candidate));
    std::int64_t best = none;
    for (std::int64_t i = cell_of(p.x) - 1; i <= cell_of(p.x) + 1; ++i)
      for (std::int64_t j = cell_of(p.y) - 1; j <= cell_of(p.y) + 1; ++j)
        for (std::int64_t k = cell_of(p.z) - 1; k <= cell_of(p.z) + 1; ++k) {
          const auto [first, last] = grid.equal_range(hash(i, j, k));
          for (auto it = first; it != last; ++it)
            if (input.are_within(candidate, it->second, within))
              best = std::min<std::int64_t>(best, it->second);
        }
    return best;
  };
  for (std::int64_t i = 0; i < input.points.cols(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    if (lowest[index] != i) { // a duplicate of an earlier input, whose target is final
      lowest[index] = lowest[static_cast<std::size_t>(lowest[index])];
      continue;
    }
    const Vec3 p = input.unit(input.at(i));
    if (const std::int64_t kept = lowest_kept(i); kept != none)
      lowest[index] = static_cast<std::int32_t>(kept);
    else
      grid.emplace(hash(cell_of(p.x), cell_of(p.y), cell_of(p.z)), static_cast<std::int32_t>(i));
  }
}

/// For each input the index of its representative; empty if no inputs merge.
template <class Input>
std::vector<std::int32_t> link_inputs(const Input& input, Order& order, double merge_within) {
  const std::int64_t n = order.size();
  const Array<std::uint64_t>& keys = order.keys;
  std::vector<std::pair<std::int64_t, std::int64_t>> runs; // of equal keys
  std::vector<std::vector<std::pair<std::int64_t, std::int64_t>>> found(
      static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      if (i + 1 == n || keys[i] != keys[i + 1])
        continue;
      if (i > 0 && keys[i - 1] == keys[i])
        continue;
      std::int64_t last = i + 2;
      while (last != n && keys[last] == keys[i])
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
    link_duplicates(input, {order.items.begin() + begin, order.items.begin() + end}, lowest);
  });
  if (merge_within > 0)
    link_near(input, merge_within, lowest);
  return lowest;
}

} // namespace calotte::delaunay_detail
