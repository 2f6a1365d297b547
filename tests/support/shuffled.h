// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/random.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace calotte::test {

inline std::vector<std::int32_t> permutation(std::int64_t n, Random& random) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  random.shuffle(order);
  return order;
}

inline std::vector<std::int32_t> inverse_of(const std::vector<std::int32_t>& order) {
  std::vector<std::int32_t> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    place[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  return place;
}

/// The triangles in random order, each starting at a random vertex; neighbours follow.
inline void shuffle_triangles(Triangles& triangles, Triangles& neighbours, Random& random) {
  const std::vector<std::int32_t> order = permutation(triangles.cols(), random);
  const std::vector<std::int32_t> place = inverse_of(order);
  const Triangles old = triangles, across = neighbours;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int first = random.integer(0, 2);
    for (int i = 0; i < 3; ++i) {
      const std::int32_t t = across((i + first) % 3, order[k]);
      triangles(i, static_cast<std::int64_t>(k)) = old((i + first) % 3, order[k]);
      neighbours(i, static_cast<std::int64_t>(k)) = t < 0 ? -1 : place[static_cast<std::size_t>(t)];
    }
  }
}

} // namespace calotte::test
