// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/memory.h"
#include "base/parallel.h"

#include <doctest/doctest.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

using namespace calotte::base_detail;

namespace {

Array<std::int32_t> filled(std::int64_t n, std::int32_t value) {
  Array<std::int32_t> array(n);
  std::fill(array.begin(), array.end(), value);
  return array;
}

bool holds(const Array<std::int32_t>& array, std::int32_t value) {
  return std::all_of(array.begin(), array.end(), [&](std::int32_t v) { return v == value; });
}

constexpr std::size_t megabyte = 1 << 20;

struct Block {
  unsigned char* begin;
  std::size_t bytes;
};

/// A block whose bytes all have a value.
Block filled_block(std::size_t bytes, unsigned char value) {
  const Block block{static_cast<unsigned char*>(pool_allocate(bytes)), bytes};
  std::fill_n(block.begin, bytes, value);
  return block;
}

bool holds(const Block& block, unsigned char value) {
  return std::all_of(block.begin, block.begin + block.bytes,
                     [&](unsigned char byte) { return byte == value; });
}

} // namespace

#ifdef __linux__
TEST_CASE("advise() reaches the whole pages of a block, and no byte beside them") {
  const std::int64_t page = sysconf(_SC_PAGESIZE);
  for (const std::int64_t begin : {std::int64_t{0}, std::int64_t{4}, page - 4, page})
    for (const std::int64_t bytes : {std::int64_t{4}, page - 4, page, 2 * page, 3 * page + 4}) {
      INFO(bytes, " bytes from ", begin, " on");
      Array<char> array(8 * page);
      std::fill(array.begin(), array.end(), 'x');
      const std::int64_t behind = reinterpret_cast<std::intptr_t>(array.begin()) % page;
      char* const first = array.begin() + (page - behind) % page; // a page's
      advise(first + begin, static_cast<std::size_t>(bytes), static_cast<std::size_t>(page),
             MADV_DONTNEED); // leaves zeros
      const std::int64_t from = (begin + page - 1) / page * page,
                         to = std::max(from, (begin + bytes) / page * page);
      CHECK(std::count(array.begin(), array.end(), '\0') == to - from);
      CHECK(std::count(first + from, first + to, '\0') == to - from);
    }
}
#endif

TEST_CASE("an array that was moved from is empty") {
  Array<std::int32_t> from = filled(100, 5);
  const Array<std::int32_t> to = std::move(from);
  CHECK(to.size() == 100);
  CHECK(from.size() == 0);
  from = {};
  CHECK(holds(to, 5));
}

TEST_CASE("blocks of the pools do not overlap") {
  std::vector<Block> blocks;
  std::size_t bytes = 1;
  for (std::size_t total = 0; total < 200 * megabyte; total += bytes) {
    bytes = bytes * 5 / 3 % (7 * megabyte) + 1;
    blocks.push_back(filled_block(bytes, static_cast<unsigned char>(blocks.size())));
  }
  for (std::size_t k = 0; k < blocks.size(); k += 2)
    pool_free(blocks[k].begin);
  for (std::size_t k = 0; k < blocks.size(); k += 2)
    blocks[k] = filled_block(blocks[k].bytes / 2 + 1, static_cast<unsigned char>(k));
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    CHECK(holds(blocks[k], static_cast<unsigned char>(k)));
    pool_free(blocks[k].begin);
  }
  pool_free(nullptr);
}

TEST_CASE("one thread frees what another allocated") {
  constexpr std::int64_t count = 4000;
  std::vector<Block> blocks(count);
  for (int round = 0; round < 3; ++round) {
    for_each_task(count, [&](std::int64_t k) {
      blocks[static_cast<std::size_t>(k)] =
          filled_block(static_cast<std::size_t>(k % 97) * 1000 + 1, static_cast<unsigned char>(k));
    });
    std::int64_t wrong = 0;
    for (std::int64_t k = 0; k < count; ++k)
      wrong += !holds(blocks[static_cast<std::size_t>(k)], static_cast<unsigned char>(k));
    CHECK(wrong == 0);
    for_each_task(count, [&](std::int64_t k) {
      pool_free(blocks[static_cast<std::size_t>(count - 1 - k)].begin);
    });
  }
  empty_pools();
}
