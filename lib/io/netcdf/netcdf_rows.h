// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/parallel.h"
#include "io/bytes/big_endian.h"
#include "io/bytes/file.h"
#include "io/netcdf/room.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

/// Rows of variables on their way to a NetCDF file.
namespace calotte::io_detail {

/// Calls body(begin, end) for consecutive ranges of the rows [first, last). A range has about
/// range_bytes, and at least one row.
template <class Body>
void for_each_rows(std::int64_t first, std::int64_t last, std::int64_t row_bytes,
                   std::int64_t range_bytes, const Body& body) {
  const std::int64_t rows = std::max<std::int64_t>(range_bytes / row_bytes, 1);
  for (std::int64_t begin = first; begin < last; begin += rows)
    body(begin, std::min(last, begin + rows));
}

/// Calls body(begin, end) for blocks of all rows, each block in its own task. Blocks are large,
/// which suits the disk, but numerous enough for all threads.
template <class Body>
void for_each_block_of_rows(std::int64_t rows, std::int64_t row_bytes, const Body& body) {
  const std::int64_t block_bytes =
      std::clamp<std::int64_t>(rows * row_bytes / 8, std::int64_t{1} << 20, std::int64_t{1} << 24);
  const std::int64_t block_rows = std::max<std::int64_t>(block_bytes / row_bytes, 1);
  for_each_task((rows + block_rows - 1) / block_rows, [&](std::int64_t block) {
    body(block * block_rows, std::min(rows, (block + 1) * block_rows));
  });
}

/// Number of bytes that are filled at once. Their conversion finds them in the cache.
inline constexpr std::int64_t fill_bytes = 1 << 17;

/// A variable whose rows follow one another in a file.
struct StoredRows {
  std::int64_t offset; ///< in the file
  std::int64_t row_values, row_bytes;
};

/// Rows of a variable, and the values that are being filled.
template <class T> struct RowBlock {
  RowBlock(OutputFile& file, const StoredRows& of, std::int64_t begin, std::int64_t end)
      : first(begin), row_values(of.row_values),
        bytes(file.block(of.offset + begin * of.row_bytes, (end - begin) * of.row_bytes)) {}

  /// Memory for the values of rows begin to end - 1.
  T* room(std::int64_t begin, std::int64_t end) {
    if (const std::int64_t count = (end - begin) * row_values; values.size() < count)
      values = Array<T>(count);
    return values.begin();
  }
  /// Converts the values in that memory, which are those of rows begin to end - 1.
  void convert(std::int64_t begin, std::int64_t end) {
    to_big_endian(values.begin(), (end - begin) * row_values,
                  bytes.begin() + (begin - first) * row_values * std::int64_t{sizeof(T)});
  }

  std::int64_t first, row_values;
  OutputBlock bytes;
  Array<T> values;
};

/// The same rows of several variables.
template <class T> struct RowBlocks {
  RowBlocks(OutputFile& file, const std::vector<StoredRows>& of, std::int64_t begin,
            std::int64_t end) {
    for (const StoredRows& rows : of)
      blocks.emplace_back(file, rows, begin, end);
  }
  T* const* room(std::int64_t begin, std::int64_t end) {
    rooms.clear();
    for (RowBlock<T>& block : blocks)
      rooms.push_back(block.room(begin, end));
    return rooms.data();
  }
  void convert(std::int64_t begin, std::int64_t end) {
    for (RowBlock<T>& block : blocks)
      block.convert(begin, end);
  }
  void put(OutputFile& file) {
    for (RowBlock<T>& block : blocks)
      file.put(std::move(block.bytes));
  }

  std::vector<RowBlock<T>> blocks;
  std::vector<T*> rooms;
};

} // namespace calotte::io_detail
