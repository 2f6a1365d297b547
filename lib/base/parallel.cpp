// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace calotte::base_detail {

void start_workers(std::int64_t items) {
  constexpr std::int64_t many = 1 << 16;
  static std::atomic<int> started{1};
  const int threads = thread_count();
  if (items < many || started.load() >= threads)
    return;
  started.store(threads);
  constexpr std::chrono::milliseconds patience{2}; // others may hold the workers
  const auto until = std::chrono::steady_clock::now() + patience;
  std::mutex mutex;
  std::condition_variable all_are_here;
  int here = 0;
  for_each_task(threads, [&](std::int64_t) {
    std::unique_lock lock(mutex);
    if (++here == threads)
      all_are_here.notify_all();
    all_are_here.wait_until(lock, until, [&] { return here == threads; });
  });
}

} // namespace calotte::base_detail
