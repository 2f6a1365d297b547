// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "base/require.h"

#include <atomic>
#include <cstdint>
#include <limits>
#include <string>

namespace calotte::base_detail {

/// The least index at which the bodies of a parallel loop found a fault: the same for any number of
/// threads.
class FirstFault {
public:
  void at(std::int64_t index) {
    std::int64_t known = first_.load(std::memory_order_relaxed);
    while (index < known && !first_.compare_exchange_weak(known, index, std::memory_order_relaxed))
      ;
  }
  /// The least index, or -1 if there is no fault.
  std::int64_t index() const {
    const std::int64_t index = first_.load(std::memory_order_relaxed);
    return index == none ? -1 : index;
  }
  /// \throws Error invalid_argument "<thing> <index> <fault>" if there is a fault.
  void refuse(const std::string& thing, const std::string& fault) const {
    if (index() >= 0)
      base_detail::refuse(message("{} {} {}", thing, index(), fault), index());
  }

private:
  static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  std::atomic<std::int64_t> first_{none};
};

} // namespace calotte::base_detail
