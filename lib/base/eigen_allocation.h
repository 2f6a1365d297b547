// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

// Keeps Eigen's own allocation functions out of line, so that the test `allocation` sees every call
// of them in the library's objects. Builds that precompile headers have it before Eigen's headers;
// no file includes it.
namespace Eigen::internal {

[[gnu::noinline]] void* aligned_malloc(std::size_t size);
[[gnu::noinline]] void* aligned_realloc(void* block, std::size_t size, std::size_t old_size);
[[gnu::noinline]] void aligned_free(void* block);

} // namespace Eigen::internal
