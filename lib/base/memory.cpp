// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/memory.h"

#include <tbb/scalable_allocator.h>

#include <cstdint>
#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace calotte::base_detail {
#if CALOTTE_POOLED
namespace {

constexpr std::size_t range_bytes = std::size_t{64} << 20, huge_page = std::size_t{2} << 20;

/// The first range: its pool never grows and lives as long as the process.
struct FirstRange {
  char* begin = nullptr;
  rml::MemoryPool* pool = nullptr;

  FirstRange() {
#ifdef __linux__
    void* const mapped = mmap(nullptr, range_bytes + huge_page, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (mapped == MAP_FAILED)
      return;
    const auto address = reinterpret_cast<std::uintptr_t>(mapped);
    begin = static_cast<char*>(mapped) + (huge_page - address % huge_page) % huge_page;
    madvise(begin, range_bytes, MADV_HUGEPAGE); // an error leaves small pages
    const rml::MemPoolPolicy policy(
        [](std::intptr_t range, std::size_t& bytes) {
          bytes = range_bytes;
          return static_cast<void*>(reinterpret_cast<FirstRange*>(range)->begin);
        },
        nullptr, range_bytes, true);
    if (rml::pool_create_v1(reinterpret_cast<std::intptr_t>(this), &policy, &pool) != rml::POOL_OK)
      pool = nullptr;
#endif
  }

  bool holds(const void* block) const {
    const auto* const address = static_cast<const char*>(block);
    return pool != nullptr && address >= begin && address < begin + range_bytes;
  }
};

const FirstRange& first_range() {
  static const FirstRange* const range = new FirstRange; // destructors of statics may still free
  return *range;
}

} // namespace
#endif

void* pool_allocate(std::size_t bytes) {
#if CALOTTE_POOLED
  if (const FirstRange& range = first_range(); range.pool != nullptr && bytes < range_bytes)
    if (void* const block = rml::pool_malloc(range.pool, bytes))
      return block;
  return scalable_malloc(bytes);
#else
  return std::malloc(bytes);
#endif
}

void pool_free(void* block) {
#if CALOTTE_POOLED
  if (const FirstRange& range = first_range(); range.holds(block))
    rml::pool_free(range.pool, block);
  else
    scalable_free(block);
#else
  std::free(block);
#endif
}

void empty_pools() {
#if CALOTTE_POOLED
  scalable_allocation_command(TBBMALLOC_CLEAN_ALL_BUFFERS, nullptr);
#ifdef __GLIBC__
  malloc_trim(0);
#endif
#endif
}

} // namespace calotte::base_detail
