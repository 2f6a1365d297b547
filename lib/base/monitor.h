// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/progress.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <string_view>

namespace calotte::base_detail {

/// Reports progress to a callback and ends the run if the callback cancels it. Stages follow one
/// another; the steps of a stage may end in any thread. Without a callback a step costs one branch.
class Monitor {
public:
  explicit Monitor(const ProgressCallback& callback) : callback_(callback ? &callback : nullptr) {}

  /// Begins a stage of `steps` steps that ends at the fraction `end`. Call it from one thread,
  /// while no step runs.
  /// \throws Error cancelled.
  void begin(std::string_view stage, double end, std::int64_t steps) {
    if (!callback_)
      return;
    stage_ = stage;
    begin_ = end_;
    end_ = std::max(end_, end);
    steps_ = std::max<std::int64_t>(steps, 1);
    done_ = 0;
    tell();
  }

  /// Ends `count` steps of the stage. Any thread may call it.
  /// \throws Error cancelled.
  void step(std::int64_t count = 1) {
    if (!callback_)
      return;
    done_.fetch_add(count, std::memory_order_relaxed);
    tell();
  }

  /// Reports the fraction 1.
  /// \param stage the last stage if another monitor ran it.
  void finish(std::string_view stage = {}) {
    if (callback_)
      (*callback_)({stage.empty() ? stage_ : stage, 1});
  }

private:
  /// Calls the callback, unless another thread is in it.
  void tell() {
    if (!ended_.load(std::memory_order_acquire) &&
        !telling_.test_and_set(std::memory_order_acquire)) {
      if (!ended_.load(std::memory_order_acquire)) // another thread's call may have ended the run
        call();
      telling_.clear(std::memory_order_release);
    }
    if (ended_.load(std::memory_order_acquire))
      std::rethrow_exception(reason_); // in all threads, because oneTBB passes on any one of them
  }

  void call() {
    try {
      if ((*callback_)({stage_, fraction()}) == ProgressReply::proceed)
        return;
      throw Error(ErrorCode::cancelled, "the progress callback cancelled the run");
    } catch (...) {
      reason_ = std::current_exception();
      ended_.store(true, std::memory_order_release);
    }
  }

  double fraction() const {
    const auto done = static_cast<double>(std::min(done_.load(), steps_));
    return begin_ + (end_ - begin_) * (done / static_cast<double>(steps_));
  }

  const ProgressCallback* callback_;
  std::string_view stage_;
  double begin_ = 0, end_ = 0; ///< of the stage
  std::int64_t steps_ = 1;
  std::atomic<std::int64_t> done_{0};
  std::atomic<bool> ended_{false};
  std::exception_ptr reason_; ///< set if the run has ended
  std::atomic_flag telling_ = ATOMIC_FLAG_INIT;
};

/// For an optional monitor: does nothing for null.
inline void step(Monitor* monitor) {
  if (monitor)
    monitor->step();
}

} // namespace calotte::base_detail
