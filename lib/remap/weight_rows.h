// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "base/require.h"
#include "remap/room.h"

#include <calotte/remap.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Rows of weights that tasks make, on their way to one matrix.
namespace calotte::remap_detail {

/// A weight of a column.
struct Weight {
  std::int32_t column;
  double value;
};
using WeightRow = std::vector<Weight>;

inline void sort_by_column(WeightRow& row) {
  const auto before = [](const Weight& a, const Weight& b) { return a.column < b.column; };
  if (!std::is_sorted(row.begin(), row.end(), before))
    std::sort(row.begin(), row.end(), before);
}

/// Adds weights of the same column. \pre sorted.
inline void merge_columns(WeightRow& row) {
  std::size_t kept = 0;
  for (const Weight& weight : row)
    if (kept > 0 && row[kept - 1].column == weight.column)
      row[kept - 1].value += weight.value;
    else
      row[kept++] = weight;
  row.resize(kept);
}

/// The matrix of rows that set_row(worker, row number, out) sets, each sorted by column and without
/// columns that repeat. A worker, which make_worker() makes for each block of rows, may keep memory
/// between them.
/// \throws Error invalid_argument for more than 2^31 - 1 weights.
template <class MakeWorker, class SetRow>
Weights matrix_of(std::int64_t rows, std::int64_t columns, const MakeWorker& make_worker,
                  const SetRow& set_row) {
  struct Block {
    std::vector<std::int32_t> counts;
    WeightRow entries;
  };
  std::vector<Block> blocks(static_cast<std::size_t>(block_count(rows)));
  for_each_block(rows, [&](std::int64_t number, std::int64_t begin, std::int64_t end) {
    Block& block = blocks[static_cast<std::size_t>(number)];
    auto worker = make_worker();
    WeightRow row;
    for (std::int64_t i = begin; i != end; ++i) {
      row.clear();
      set_row(worker, i, row);
      block.counts.push_back(static_cast<std::int32_t>(row.size()));
      block.entries.insert(block.entries.end(), row.begin(), row.end());
    }
  });
  std::int64_t entries = 0;
  for (const Block& block : blocks)
    entries += std::ssize(block.entries);
  require(entries <= std::numeric_limits<int>::max(),
          "{} weights are too many; give fewer positions at a time", entries);
  Weights out(rows, columns);
  out.resizeNonZeros(entries);
  std::int64_t row = 0, entry = 0;
  for (const Block& block : blocks) {
    for (const std::int32_t count : block.counts) {
      out.outerIndexPtr()[row + 1] = out.outerIndexPtr()[row] + count;
      ++row;
    }
    for (const Weight& weight : block.entries) {
      out.innerIndexPtr()[entry] = weight.column;
      out.valuePtr()[entry++] = weight.value;
    }
  }
  return out;
}

/// The same where rows need no memory between them.
template <class SetRow>
Weights matrix_of(std::int64_t rows, std::int64_t columns, const SetRow& set_row) {
  struct None {};
  return matrix_of(
      rows, columns, [] { return None{}; },
      [&](None&, std::int64_t i, WeightRow& row) { set_row(i, row); });
}

} // namespace calotte::remap_detail
