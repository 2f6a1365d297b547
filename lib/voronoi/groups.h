// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "voronoi/room.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace calotte::voronoi_detail {

/// Sorts items by a key from 0 to keys - 1, and those of one key by `less`, which is to tell all of
/// them apart. The time is linear if few items share a key.
template <class Item, class Key, class Less>
void sort_in_groups(std::int64_t keys, const Key& key, const Less& less, std::vector<Item>& items) {
  std::vector<std::int64_t> begin(static_cast<std::size_t>(keys) + 1);
  for (const Item& item : items)
    ++begin[static_cast<std::size_t>(key(item)) + 1];
  for (std::size_t k = 1; k < begin.size(); ++k)
    begin[k] += begin[k - 1];
  std::vector<Item> sorted(items.size());
  std::vector<std::int64_t> next = begin;
  for (const Item& item : items)
    sorted[static_cast<std::size_t>(next[static_cast<std::size_t>(key(item))]++)] = item;
  for_each_block(keys, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (auto k = static_cast<std::size_t>(first); k != static_cast<std::size_t>(last); ++k)
      std::sort(sorted.begin() + begin[k], sorted.begin() + begin[k + 1], less);
  });
  items.swap(sorted);
}

} // namespace calotte::voronoi_detail
