// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "curve/room.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace calotte::curve_detail {

/// Puts items into buckets in parallel, in linear time. The items of a bucket keep their order.
/// \tparam Index type that counts the items.
/// \param bucket_of(i) bucket of item i, below `buckets`; called twice per item.
/// \param put(i, index) receives the index of each item.
/// \return where each bucket begins, and the number of items.
template <class Index = std::int32_t, class BucketOf, class Put>
std::vector<Index> distribute(std::int64_t n, std::int64_t buckets, const BucketOf& bucket_of,
                              const Put& put) {
  // Each part of the items has its own counts, in cache. The number of parts is small, so that the
  // counts take little memory compared with the items.
  const std::int64_t parts = std::clamp<std::int64_t>(n / (8 * buckets), 1, 64);
  constexpr std::int64_t group = 64; // of buckets, whose counts are a run of memory in each part
  const std::int64_t groups = (buckets + group - 1) / group;
  Array<Index> next(parts * buckets); // of [part, bucket]: first counts, then indices
  const auto for_each_part = [&](const auto& body) {
    for_each_task(parts, [&](std::int64_t part) {
      body(next.begin() + part * buckets, n * part / parts, n * (part + 1) / parts);
    });
  };
  const auto for_each_group = [&](const auto& body) {
    for_each_task(groups,
                  [&](std::int64_t g) { body(g, g * group, std::min((g + 1) * group, buckets)); });
  };
  for_each_part([&](Index* count, std::int64_t begin, std::int64_t end) {
    std::fill(count, count + buckets, 0);
    for (std::int64_t i = begin; i != end; ++i)
      ++count[bucket_of(i)];
  });
  std::vector<Index> first(static_cast<std::size_t>(buckets + 1));
  for_each_group([&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t part = 0; part != parts; ++part)
      for (std::int64_t b = begin; b != end; ++b)
        first[static_cast<std::size_t>(b)] += next[part * buckets + b];
  });
  exclusive_scan(std::span(first));
  for_each_group([&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::array<Index, group> index;
    std::copy(first.begin() + begin, first.begin() + end, index.begin());
    for (std::int64_t part = 0; part != parts; ++part)
      for (std::int64_t b = begin; b != end; ++b) {
        Index& slot = index[static_cast<std::size_t>(b - begin)];
        slot += std::exchange(next[part * buckets + b], slot);
      }
  });
  for_each_part([&](Index* index, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      put(i, index[bucket_of(i)]++);
  });
  return first;
}

struct KeyedItem {
  std::uint64_t key;
  std::int32_t item;
};

inline bool precedes(const KeyedItem& a, const KeyedItem& b) {
  return a.key != b.key ? a.key < b.key : a.item < b.item;
}

/// Items in ascending order of their keys; items of equal keys keep their order.
struct Order {
  Array<std::uint64_t> keys;
  Array<std::int32_t> items;

  std::int64_t size() const { return keys.size(); }
};

/// Radix sort from the leading bits: linear time; the number of passes grows with the clustering of
/// the keys.
/// \param keys by item, below 2^key_bits; fewer than 2^31.
Order order_by_key(Array<std::uint64_t> keys);

} // namespace calotte::curve_detail
