// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <ctime>

namespace calotte::bench {

struct Timed {
  double seconds = 0;     ///< wall-clock
  double cpu_seconds = 0; ///< of all threads in that time
};

/// Measures from its construction.
class Stopwatch {
public:
  void stop(Timed& timed) const {
    timed.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    timed.cpu_seconds = static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC;
  }

private:
  using Clock = std::chrono::steady_clock;
  std::clock_t cpu_start_ = std::clock();
  Clock::time_point start_ = Clock::now();
};

} // namespace calotte::bench
