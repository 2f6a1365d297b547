// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/canonical_order.h"

#include "base/parallel.h"
#include "base/triangle.h"
#include "mesh/by_vertex.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

namespace calotte::mesh_detail {
namespace {

using Triple = std::array<std::int32_t, 3>;

Triple triple(const Triangles& matrix, std::int64_t t) {
  return {matrix(0, t), matrix(1, t), matrix(2, t)};
}

/// The vertex at which a triangle starts. If vertices repeat, which a file may contain, the start
/// with the lowest ids.
int first_vertex(const Triple& ids) {
  const auto vertex = [&](int i) { return ids[static_cast<std::size_t>(i)]; };
  int best = 0;
  for (const int i : {1, 2})
    if (vertex(i) < vertex(best) ||
        (vertex(i) == vertex(best) && vertex(next_vertex(i)) < vertex(next_vertex(best))))
      best = i;
  return best;
}

Triple turned(const Triple& ids, int first) {
  const auto vertex = [&](int i) { return ids[static_cast<std::size_t>(i)]; };
  return {vertex(first), vertex(next_vertex(first)), vertex(previous_vertex(first))};
}

/// The triangles under their new names.
struct Renamed {
  const Triangles& triangles;
  std::span<const std::int32_t> new_id;

  std::int64_t size() const { return triangles.cols(); }
  Triple operator[](std::int64_t t) const {
    Triple ids = triple(triangles, t);
    if (!new_id.empty())
      for (std::int32_t& id : ids)
        id = new_id[static_cast<std::size_t>(id)];
    return ids;
  }
};

std::int32_t highest_id(const Triangles& triangles) {
  std::vector<std::int32_t> highest(static_cast<std::size_t>(block_count(triangles.cols())));
  for_each_block(triangles.cols(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    highest[static_cast<std::size_t>(block)] = triangles.middleCols(begin, end - begin).maxCoeff();
  });
  return highest.empty() ? 0 : *std::max_element(highest.begin(), highest.end());
}

/// A triangle that starts at its lowest vertex, with its old index.
struct Moved {
  Triple ids;
  std::int32_t from;

  std::int32_t vertex() const { return ids[0]; }
  bool operator<(const Moved& other) const {
    return std::tie(ids, from) < std::tie(other.ids, other.from);
  }
};

} // namespace

CanonicalOrder order_triangles(const Triangles& triangles, std::span<const std::int32_t> new_id,
                               Triangles& out) {
  const Renamed renamed{triangles, new_id};
  const std::int64_t count = renamed.size();
  const std::int64_t sites =
      new_id.empty() ? std::int64_t{highest_id(triangles)} + 1 : std::ssize(new_id);
  CanonicalOrder order{Array<std::int32_t>(count), Array<std::int8_t>(count)};
  const auto lowest = [&](std::int64_t t) {
    const Triple ids = renamed[t];
    return std::min({ids[0], ids[1], ids[2]});
  };
  const auto moved = [&](std::int64_t t) {
    const Triple ids = renamed[t];
    const int first = first_vertex(ids);
    order.first[t] = static_cast<std::int8_t>(first);
    return Moved{turned(ids, first), static_cast<std::int32_t>(t)};
  };
  out.resize(3, count);
  for_each_vertex_block<std::int32_t, Moved>(
      count, sites, lowest, moved, [&](std::int32_t k, const std::vector<Moved>& sorted) {
        for (const Moved& triangle : sorted) {
          order.index[triangle.from] = k;
          for (int i = 0; i < 3; ++i)
            out(i, k) = triangle.ids[static_cast<std::size_t>(i)];
          ++k;
        }
      });
  return order;
}

void order_neighbours(const Triangles& neighbours, const CanonicalOrder& order, Triangles& out) {
  constexpr std::int64_t ahead = 16;
  out.resize(3, neighbours.cols());
  for_each_block(neighbours.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t) {
      if (t + ahead < end)
        __builtin_prefetch(&out(0, order.index[t + ahead]), 1);
      const Triple across = turned(triple(neighbours, t), order.first[t]);
      for (int i = 0; i < 3; ++i) {
        const std::int32_t old = across[static_cast<std::size_t>(i)];
        out(i, order.index[t]) = old < 0 ? -1 : order.index[old];
      }
    }
  });
}

void make_canonical(Triangles& triangles, Triangles& neighbours,
                    std::span<const std::int32_t> new_id) {
  Triangles ordered;
  const CanonicalOrder order = order_triangles(triangles, new_id, ordered);
  triangles = std::move(ordered); // frees the old ones before the neighbours are allocated
  if (neighbours.cols() == 0)
    return;
  Triangles across;
  order_neighbours(neighbours, order, across);
  neighbours = std::move(across);
}

bool is_canonical(const Triangles& triangles) {
  return holds_for_blocks(triangles.cols(), [&](std::int64_t begin, std::int64_t end) {
    Triple before = triple(triangles, std::max<std::int64_t>(begin - 1, 0));
    for (std::int64_t t = begin; t != end; ++t) {
      const Triple ids = triple(triangles, t);
      if (first_vertex(ids) != 0 || ids < before)
        return false;
      before = ids;
    }
    return true;
  });
}

} // namespace calotte::mesh_detail
