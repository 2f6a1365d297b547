// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

/// The only loops over threads. They run in the caller's task arena. Each body writes its own
/// slots, so that no result depends on the number of threads.
namespace calotte::base_detail {

int thread_count();

/// Calls call(body, i) for 0 <= i < n, each in its own task. All loops use this one function: each
/// further type of task would take tenths of a second to compile.
void run_tasks(std::int64_t n, void (*call)(const void* body, std::int64_t i), const void* body);

/// Calls body(i) for 0 <= i < n, each in its own task.
template <class Body> void for_each_task(std::int64_t n, const Body& body) {
  run_tasks(
      n, [](const void* of, std::int64_t i) { (*static_cast<const Body*>(of))(i); }, &body);
}

/// The number of blocks that for_each_block and exclusive_scan cut n items into: a function of n
/// alone.
inline std::int64_t block_count(std::int64_t n) {
  constexpr std::int64_t block = 1 << 11; // so that loops over few items use all threads, too
  return (n + block - 1) / block;
}

/// Calls body(block, begin, end) for consecutive blocks of [0, n), in parallel.
template <class Body> void for_each_block(std::int64_t n, const Body& body) {
  const std::int64_t blocks = block_count(n);
  for_each_task(blocks, [&](std::int64_t block) {
    body(block, n * block / blocks, n * (block + 1) / blocks);
  });
}

/// Consecutive items, such as a block of for_each_block.
struct Part {
  std::int64_t begin, end;

  std::int64_t size() const { return end - begin; }
};

/// The sums of several terms over n items, added in the order of the blocks: the same bits for any
/// number of threads.
/// \param set_sums(part, sums) sets the sums over a block.
template <class SetSums>
std::vector<double> sums_over_blocks(std::int64_t n, std::size_t terms, const SetSums& set_sums) {
  std::vector<double> sums(terms * static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    set_sums(Part{begin, end},
             std::span(sums).subspan(terms * static_cast<std::size_t>(block), terms));
  });
  std::vector<double> totals(terms, 0);
  for (std::size_t i = 0; i < sums.size(); ++i)
    totals[i % terms] += sums[i];
  return totals;
}

/// True if holds(begin, end) is true for all blocks of [0, n).
template <class Holds> bool holds_for_blocks(std::int64_t n, const Holds& holds) {
  std::atomic<bool> all = true;
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    if (all.load(std::memory_order_relaxed) && !holds(begin, end))
      all.store(false, std::memory_order_relaxed);
  });
  return all;
}

/// Replaces each value by the sum of those before it; returns the sum of all.
template <class T> T exclusive_scan(std::span<T> values) {
  const auto n = static_cast<std::int64_t>(values.size());
  std::vector<T> before(static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    T sum = 0;
    for (std::int64_t i = begin; i != end; ++i)
      sum += values[static_cast<std::size_t>(i)];
    before[static_cast<std::size_t>(block)] = sum;
  });
  T total = 0;
  for (T& sum : before)
    total += std::exchange(sum, total);
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    T sum = before[static_cast<std::size_t>(block)];
    for (std::int64_t i = begin; i != end; ++i)
      sum += std::exchange(values[static_cast<std::size_t>(i)], sum);
  });
  return total;
}

/// Runs work during which this thread executes no unrelated task. The work may therefore run under
/// a lock or within std::call_once().
void in_isolation(const std::function<void()>& work);

} // namespace calotte::base_detail
