// SPDX-License-Identifier: GPL-3.0-or-later
#include "order.h"

#include "curve.h"

#include <algorithm>

namespace calotte::detail {
namespace {

constexpr int key_bits = 3 + 2 * curve_levels;
constexpr int first_digit = 12, digit = 8;

/// Sorts [begin, end), whose keys agree above bit `shift`, with `buffer` of the same length to
/// spare. The inner loops of comparison sorts mispredict; a digit pass does not, so short runs
/// alone are compared.
void sort_run(KeyedIndex* begin, KeyedIndex* end, KeyedIndex* buffer, int shift) {
  if (end - begin <= 24 || shift <= 0) {
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
      sort_run(begin + first[d], begin + first[d + 1], buffer + first[d], down);
}

} // namespace

void sort_by_key(Array<KeyedIndex>& entries) {
  constexpr int shift = key_bits - first_digit;
  constexpr std::int64_t buckets = std::int64_t{1} << first_digit;
  Array<KeyedIndex> sorted(entries.size());
  const std::vector<std::int32_t> first = distribute(
      entries.size(), buckets, [&](std::int64_t i) { return entries[i].key >> shift; },
      [&](std::int64_t i, std::int32_t place) { sorted[place] = entries[i]; });
  for_each_task(buckets / 16, [&](std::int64_t group) {
    for (auto b = static_cast<std::size_t>(16 * group);
         b < static_cast<std::size_t>(16 * group + 16); ++b)
      sort_run(sorted.begin() + first[b], sorted.begin() + first[b + 1], entries.begin() + first[b],
               shift);
  });
  entries = std::move(sorted);
}

} // namespace calotte::detail
