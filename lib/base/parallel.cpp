// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace calotte::base_detail {
namespace {

/// Annotations for ThreadSanitizer, which cannot see the synchronisation in Debian's libtbb because
/// that is not instrumented. They state that everything before a parallel loop happens before each
/// of its bodies, and each body before everything after the loop. Two bodies remain unordered, so
/// that races between them are still found. In other builds the functions do nothing.
class HappensBefore {
#ifdef __SANITIZE_THREAD__
#define CALOTTE_UNSEEN                                                                             \
  __attribute__((no_sanitize("thread"))) // for the code between oneTBB and the body
public:
  void fork() { __tsan_release(&forked_); }
  void enter() { __tsan_acquire(&forked_); }
  void leave() { __tsan_release(&left_); }
  void join() { __tsan_acquire(&left_); }

private:
  char forked_ = 0;
  char left_ = 0;
#else
#define CALOTTE_UNSEEN
public:
  void fork() {}
  void enter() {}
  void leave() {}
  void join() {}
#endif
};

} // namespace

int thread_count() { return tbb::this_task_arena::max_concurrency(); }

void run_tasks(std::int64_t n, void (*call)(const void* body, std::int64_t i), const void* body) {
  HappensBefore order;
  order.fork();
  tbb::parallel_for(
      tbb::blocked_range<std::int64_t>(0, n, 1),
      [&](const tbb::blocked_range<std::int64_t>& range) CALOTTE_UNSEEN {
        order.enter();
        for (std::int64_t i = range.begin(); i != range.end(); ++i)
          call(body, i);
        order.leave();
      },
      tbb::simple_partitioner());
  order.join();
}

void in_isolation(const std::function<void()>& work) { tbb::this_task_arena::isolate(work); }

} // namespace calotte::base_detail
