// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/memory.h"

#include <tbb/scalable_allocator.h>

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace calotte::base_detail {

void* pool_allocate(std::size_t bytes) {
#if CALOTTE_POOLED
  return scalable_malloc(bytes);
#else
  return std::malloc(bytes);
#endif
}

void pool_free(void* block) {
#if CALOTTE_POOLED
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
