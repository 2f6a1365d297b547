// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/parallel.h"
#include "curve/radix_sort.h"
#include "mesh/room.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

/// Sorts items that belong to vertices by vertex, in linear time, in parallel.
namespace calotte::mesh_detail {

/// Blocks of vertices: the items of one stay in cache while they are sorted.
inline constexpr int vertex_block_bits = 12;

/// The items of one block, sorted by vertex, then by value. Most vertices have a few.
template <class Item> std::vector<Item> sorted_block(std::span<const Item> block) {
  constexpr std::int32_t mask = (1 << vertex_block_bits) - 1;
  std::vector<std::int32_t> ends(std::size_t{1} << vertex_block_bits);
  const auto slot = [&](const Item& item) -> std::int32_t& {
    return ends[static_cast<std::size_t>(item.vertex() & mask)];
  };
  for (const Item& item : block)
    ++slot(item);
  std::int32_t sum = 0;
  for (std::int32_t& end : ends)
    sum += std::exchange(end, sum);
  std::vector<Item> out(block.size());
  for (const Item& item : block) // replaces the start of a run by its end
    out[static_cast<std::size_t>(slot(item)++)] = item;
  std::int32_t begin = 0;
  for (const std::int32_t end : ends) {
    if (end - begin > 1)
      std::sort(out.begin() + begin, out.begin() + end);
    begin = end;
  }
  return out;
}

/// Calls body(first, sorted) for each block of vertices with its items; `first` is the index of the
/// first item in the order of all.
/// \tparam Index type that counts the items.
/// \tparam Item has a vertex() and an operator< that compares all of it, vertices first.
/// \param vertex_of(i) vertex of item i, below `vertices`.
/// \param item_of(i) called once, in order within each part of the items.
template <class Index, class Item, class VertexOf, class ItemOf, class Body>
void for_each_vertex_block(std::int64_t items, std::int64_t vertices, const VertexOf& vertex_of,
                           const ItemOf& item_of, const Body& body) {
  const std::int64_t blocks =
      std::max<std::int64_t>(vertices - 1, 0) / (1 << vertex_block_bits) + 1;
  Array<Item> by_block(items);
  const std::vector<Index> begin = distribute<Index>(
      items, blocks, [&](std::int64_t i) { return vertex_of(i) >> vertex_block_bits; },
      [&](std::int64_t i, Index index) { by_block[index] = item_of(i); });
  for_each_task(blocks, [&](std::int64_t block) {
    const Index first = begin[static_cast<std::size_t>(block)],
                end = begin[static_cast<std::size_t>(block) + 1];
    body(first,
         sorted_block(std::span<const Item>(by_block.begin() + first, by_block.begin() + end)));
  });
}

} // namespace calotte::mesh_detail
