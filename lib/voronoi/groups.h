// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/lists.h"
#include "base/parallel.h"
#include "voronoi/room.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace calotte::voronoi_detail {

/// Sorts items by a key from 0 to keys - 1, and items of one key by `less`, which must be a strict
/// order of them. Linear time if few items share a key.
/// \returns for each key where its items begin, and their number.
template <class Item, class Key, class Less>
std::vector<std::int64_t> sort_in_groups(std::int64_t keys, const Key& key, const Less& less,
                                         std::vector<Item>& items) {
  auto lists = lists_by_key<std::vector<Item>>(keys, [&](const auto& put) {
    for (const Item& item : items)
      put(key(item), item);
  });
  for_each_block(keys, [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t k = first; k != last; ++k)
      std::sort(lists[k].begin(), lists[k].end(), less);
  });
  items.swap(lists.items);
  return std::move(lists.begin);
}

} // namespace calotte::voronoi_detail
