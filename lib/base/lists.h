// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/room.h"

#include <calotte/matrices.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace calotte::base_detail {

inline constexpr std::int32_t none = -1; ///< where a list or a table has no id

/// The list that contains an item. \param item its index among all items.
template <class Items, class Begin>
std::int64_t list_of(const Lists<Items, Begin>& lists, std::int64_t item) {
  return std::upper_bound(lists.begin.begin(), lists.begin.end(), item) - lists.begin.begin() - 1;
}

/// The index of the item that follows one in its list; the first one follows the last.
template <class Items, class Begin>
std::int32_t next_in_list(const Lists<Items, Begin>& lists, std::int32_t item) {
  const auto list = static_cast<std::size_t>(list_of(lists, item));
  return item + 1 == lists.begin[list + 1] ? lists.begin[list] : item + 1;
}

/// Groups items by a key from 0 to keys - 1. Items of one key keep their order.
/// \tparam Items a std::vector.
/// \param for_each(put) calls put(key, item) for each item; it is called twice.
template <class Items, class ForEach>
Lists<Items, std::vector<std::int64_t>> lists_by_key(std::int64_t keys, const ForEach& for_each) {
  using Item = typename Items::value_type;
  Lists<Items, std::vector<std::int64_t>> out;
  out.begin.resize(static_cast<std::size_t>(keys) + 1);
  for_each([&](std::int64_t key, const Item&) { ++out.begin[static_cast<std::size_t>(key) + 1]; });
  for (std::size_t k = 1; k < out.begin.size(); ++k)
    out.begin[k] += out.begin[k - 1];
  out.items.resize(static_cast<std::size_t>(out.begin.back()));
  std::vector<std::int64_t> next = out.begin;
  for_each([&](std::int64_t key, const Item& item) {
    out.items[static_cast<std::size_t>(next[static_cast<std::size_t>(key)]++)] = item;
  });
  return out;
}

} // namespace calotte::base_detail
