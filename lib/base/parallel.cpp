// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>

#ifdef __linux__
#include <sched.h>
#endif

namespace calotte::base_detail {

#ifdef __linux__
namespace {

constexpr int thread_bits = 16;

/// By processor: the loop and the thread that ran there last, as (loop << thread_bits) + thread. A
/// hint only: a thread that the system moves leaves its claim behind until the loop ends, and
/// loops that run at the same time overwrite each other's.
std::array<std::atomic<std::uint64_t>, CPU_SETSIZE> claims{};

std::atomic<std::uint64_t> last_loop{0}, next_thread{0};

/// What a thread knows of itself.
struct Self {
  std::uint64_t number =
      next_thread.fetch_add(1, std::memory_order_relaxed) & ((1U << thread_bits) - 1);
  std::uint64_t placed = 0; ///< the last loop in which it looked for a free processor
};
thread_local Self self;

/// Claims a processor of the set that no thread of the loop has claimed; -1 if there is none.
int claim_free(const cpu_set_t& allowed, int from, std::uint64_t mine) {
  for (int step = 1; step < CPU_SETSIZE; ++step) {
    const int cpu = (from + step) % CPU_SETSIZE;
    if (!CPU_ISSET(cpu, &allowed))
      continue;
    std::atomic<std::uint64_t>& claim = claims[static_cast<std::size_t>(cpu)];
    std::uint64_t last = claim.load(std::memory_order_relaxed);
    if (last >> thread_bits != mine >> thread_bits &&
        claim.compare_exchange_strong(last, mine, std::memory_order_relaxed))
      return cpu;
  }
  return -1;
}

/// Moves the calling thread, within its affinity mask. Errors are ignored: a sandbox may forbid it.
void move_from(int cpu, std::uint64_t mine) {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0)
    return;
  const int free = claim_free(allowed, cpu, mine);
  if (free < 0)
    return;
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(free, &only);
  if (sched_setaffinity(0, sizeof only, &only) == 0)
    sched_setaffinity(0, sizeof allowed, &allowed);
}

/// Claims the calling thread's processor, or moves the thread if another one of the loop has
/// claimed it.
void take_processor(std::uint64_t loop) {
  const int cpu = sched_getcpu();
  if (cpu < 0 || cpu >= CPU_SETSIZE)
    return;
  const std::uint64_t mine = (loop << thread_bits) + self.number;
  std::atomic<std::uint64_t>& claim = claims[static_cast<std::size_t>(cpu)];
  const std::uint64_t last = claim.load(std::memory_order_relaxed);
  if (last == mine)
    return;
  if (last >> thread_bits != loop) {
    claim.store(mine, std::memory_order_relaxed);
  } else if (self.placed != loop) { // once a loop, where there are more threads than processors
    self.placed = loop;
    move_from(cpu, mine);
  }
}

} // namespace

Placement::Placement(int threads) : shared_(threads > 1) {
  if (!shared_)
    return;
  loop_ = last_loop.fetch_add(1, std::memory_order_relaxed) + 1;
  caller_ = self.number;
  start_ = Clock::now();
  take_processor(loop_);
}

void Placement::place() {
  take_processor(loop_);
  if (joined_.load(std::memory_order_relaxed))
    return;
  constexpr std::chrono::microseconds patience{100}; // a thread wakes in less
  if (self.number != caller_) {
    joined_.store(true, std::memory_order_relaxed);
  } else if (!yielded_ && Clock::now() - start_ > patience) {
    yielded_ = true;
    sched_yield();
  }
}

#else
Placement::Placement(int) : shared_(false) {}
void Placement::place() {}
#endif

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
