// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// What a sanitizer changes in tests.
namespace calotte::test {

/// Whether AddressSanitizer or ThreadSanitizer watches. The library is then twenty to fifty times
/// as slow, and a test takes fewer of its inputs: these reach the same code, and the release build
/// takes all.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

} // namespace calotte::test
