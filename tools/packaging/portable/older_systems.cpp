// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that the C and C++ libraries of Debian 12 have, and those of glibc 2.34 and GCC 11 have
// not, or in another version. Binaries of the preset portable take them from here.
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <cstdlib>
#include <mutex>

#include <pthread.h>
#include <unistd.h>

extern "C" {

/// Expat draws a salt for its tables. glibc has it since 2.36.
void arc4random_buf(void* buffer, std::size_t size) {
  constexpr std::size_t most = 256; // of one call
  for (auto* byte = static_cast<char*>(buffer); size > 0;) {
    const std::size_t part = size < most ? size : most;
    if (getentropy(byte, part) != 0)
      std::abort();
    byte += part, size -= part;
  }
}

/// Cairo draws with it. glibc 2.35 has a version of its own.
double hypot(double x, double y) {
  const double a = std::fabs(x), b = std::fabs(y), larger = a > b ? a : b;
  if (std::isinf(a) || std::isinf(b))
    return HUGE_VAL;
  if (a == 0 && b == 0)
    return 0;
  return larger * std::sqrt((a / larger) * (a / larger) + (b / larger) * (b / larger));
}
}

/// GCC 12 has a version of its own, which throws nothing.
void std::condition_variable::wait(std::unique_lock<std::mutex>& lock) {
  pthread_cond_wait(native_handle(), lock.mutex()->native_handle());
}
