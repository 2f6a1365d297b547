// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <utility>

namespace calotte::base_detail {

using Clock = std::chrono::steady_clock;

/// Moves a mark to now; returns the seconds since its last position.
inline double restart_clock(Clock::time_point& mark) {
  const Clock::time_point before = std::exchange(mark, Clock::now());
  return std::chrono::duration<double>(mark - before).count();
}

} // namespace calotte::base_detail
