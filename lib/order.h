// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "parallel.h"

#include <cstdint>

namespace calotte::detail {

/// A curve key and the input it belongs to.
struct KeyedIndex {
  std::uint64_t key;
  std::int32_t index;
};

inline bool precedes(const KeyedIndex& a, const KeyedIndex& b) {
  return a.key != b.key ? a.key < b.key : a.index < b.index;
}

/// Sorts by key, equal keys by index. Radix sort from the leading bits: linear time, and as many
/// passes as the keys' crowding needs.
void sort_by_key(Array<KeyedIndex>& entries);

} // namespace calotte::detail
