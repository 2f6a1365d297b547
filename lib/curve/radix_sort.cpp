// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/radix_sort.h"

#include "curve/hilbert.h"

#include <algorithm>
#include <span>

namespace calotte::curve_detail {
namespace {

constexpr int first_digit = 12, digit = 8;
/// Longest run that is sorted by comparison. The inner loops of comparison sorts mispredict; a
/// digit pass does not.
constexpr std::int64_t short_run = 24;

/// Sorts [begin, end), whose keys agree above bit `shift`. `buffer` is scratch of the same length.
void sort_run(KeyedItem* begin, KeyedItem* end, KeyedItem* buffer, int shift) {
  if (end - begin <= short_run || shift <= 0) {
    std::sort(begin, end, precedes);
    return;
  }
  const int down = std::max(shift - digit, 0);
  constexpr std::uint64_t mask = (1U << digit) - 1;
  std::array<std::int32_t, mask + 2> first{};
  for (const KeyedItem* e = begin; e != end; ++e)
    ++first[(e->key >> down & mask) + 1];
  for (std::size_t d = 1; d < first.size(); ++d)
    first[d] += first[d - 1];
  std::array<std::int32_t, mask + 2> index = first;
  for (const KeyedItem* e = begin; e != end; ++e)
    buffer[index[static_cast<std::size_t>(e->key >> down & mask)]++] = *e;
  std::copy(buffer, buffer + (end - begin), begin);
  for (std::size_t d = 0; d <= mask; ++d)
    if (first[d + 1] - first[d] > 1)
      sort_run(begin + first[d], begin + first[d + 1], buffer, down);
}

/// Sorts keys together with their items; `run` and `buffer` are scratch of their length.
void sort_bucket(std::span<std::uint64_t> keys, std::int32_t* items, KeyedItem* run,
                 KeyedItem* buffer) {
  for (std::size_t i = 0; i < keys.size(); ++i)
    run[i] = {keys[i], items[i]};
  sort_run(run, run + keys.size(), buffer, key_bits - first_digit);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    keys[i] = run[i].key;
    items[i] = run[i].item;
  }
}

/// Sorts the buckets of the first digit. A task sorts several buckets, one after another in the
/// same memory, which stays in cache if the keys are well spread.
void sort_buckets(std::span<const std::int32_t> first, Order& order) {
  constexpr std::size_t group = 16;
  static_assert((1 << first_digit) % group == 0);
  for_each_task((1 << first_digit) / group, [&](std::int64_t g) {
    const std::size_t begin = static_cast<std::size_t>(g) * group;
    const auto size = [&](std::size_t b) { return first[b + 1] - first[b]; };
    std::int32_t largest = 0;
    for (std::size_t b = begin; b != begin + group; ++b)
      largest = std::max(largest, size(b));
    if (largest < 2)
      return;
    Array<KeyedItem> run(largest), buffer(largest);
    for (std::size_t b = begin; b != begin + group; ++b)
      sort_bucket({order.keys.begin() + first[b], static_cast<std::size_t>(size(b))},
                  order.items.begin() + first[b], run.begin(), buffer.begin());
  });
}

} // namespace

Order order_by_key(Array<std::uint64_t> keys) {
  constexpr int shift = key_bits - first_digit;
  Order order{Array<std::uint64_t>(keys.size()), Array<std::int32_t>(keys.size())};
  const std::vector<std::int32_t> first = distribute(
      keys.size(), std::int64_t{1} << first_digit, [&](std::int64_t i) { return keys[i] >> shift; },
      [&](std::int64_t i, std::int32_t index) {
        order.keys[index] = keys[i];
        order.items[index] = static_cast<std::int32_t>(i);
      });
  keys = {};
  sort_buckets(first, order);
  return order;
}

} // namespace calotte::curve_detail
