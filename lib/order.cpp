// SPDX-License-Identifier: GPL-3.0-or-later
#include "order.h"

#include <algorithm>

namespace calotte::detail {
namespace {

constexpr int first_digit = 12, digit = 8;
/// Comparison sorts mispredict in their inner loops, a digit pass does not: runs up to this length
/// alone are compared.
constexpr std::int64_t short_run = 24;

/// Sorts [begin, end), whose keys agree above bit `shift`, with `buffer` of the same length to
/// spare.
void sort_run(KeyedIndex* begin, KeyedIndex* end, KeyedIndex* buffer, int shift) {
  if (end - begin <= short_run || shift <= 0) {
    std::sort(begin, end, precedes);
    return;
  }
  const int down = std::max(shift - digit, 0);
  constexpr std::uint64_t mask = (1U << digit) - 1;
  std::array<std::int32_t, mask + 2> first{};
  for (const KeyedIndex* e = begin; e != end; ++e)
    ++first[(e->key >> down & mask) + 1];
  for (std::size_t d = 1; d < first.size(); ++d)
    first[d] += first[d - 1];
  std::array<std::int32_t, mask + 2> place = first;
  for (const KeyedIndex* e = begin; e != end; ++e)
    buffer[place[static_cast<std::size_t>(e->key >> down & mask)]++] = *e;
  std::copy(buffer, buffer + (end - begin), begin);
  for (std::size_t d = 0; d <= mask; ++d)
    if (first[d + 1] - first[d] > 1)
      sort_run(begin + first[d], begin + first[d + 1], buffer, down);
}

/// Sorts a bucket's keys together with its items, in memory that the next bucket uses again.
class BucketSorter {
public:
  explicit BucketSorter(std::int64_t largest) : run_(largest), buffer_(largest) {}

  void sort(std::uint64_t* keys, std::int32_t* items, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i)
      run_[i] = {keys[i], items[i]};
    sort_run(run_.begin(), run_.begin() + count, buffer_.begin(), key_bits - first_digit);
    for (std::int64_t i = 0; i < count; ++i) {
      keys[i] = run_[i].key;
      items[i] = run_[i].index;
    }
  }

private:
  Array<KeyedIndex> run_, buffer_;
};

/// Sorts the buckets of the first digit, each in cache.
void sort_buckets(const std::vector<std::int32_t>& first, Order& order) {
  constexpr std::size_t group = 16;
  const std::size_t buckets = first.size() - 1;
  for_each_task(static_cast<std::int64_t>(buckets / group), [&](std::int64_t g) {
    const std::size_t begin = static_cast<std::size_t>(g) * group;
    const auto size = [&](std::size_t b) { return first[b + 1] - first[b]; };
    std::int64_t largest = 0;
    for (std::size_t b = begin; b != begin + group; ++b)
      largest = std::max<std::int64_t>(largest, size(b));
    BucketSorter sorter(largest);
    for (std::size_t b = begin; b != begin + group; ++b)
      if (size(b) > 1)
        sorter.sort(order.keys.begin() + first[b], order.items.begin() + first[b], size(b));
  });
}

} // namespace

Order order_by_key(Array<std::uint64_t> keys) {
  constexpr int shift = key_bits - first_digit;
  Order order{Array<std::uint64_t>(keys.size()), Array<std::int32_t>(keys.size())};
  const std::vector<std::int32_t> first = distribute(
      keys.size(), std::int64_t{1} << first_digit, [&](std::int64_t i) { return keys[i] >> shift; },
      [&](std::int64_t i, std::int32_t place) {
        order.keys[place] = keys[i];
        order.items[place] = static_cast<std::int32_t>(i);
      });
  keys = {};
  sort_buckets(first, order);
  return order;
}

} // namespace calotte::detail
