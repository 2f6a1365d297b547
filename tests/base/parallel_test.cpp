// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"

#include <doctest/doctest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sched.h>
#endif

using namespace calotte::base_detail;

TEST_CASE("the wait for threads ends while others hold them") {
  std::atomic<bool> done = false;
  std::atomic<int> held = 0;
  std::thread holder([&] {
    tbb::parallel_for(0, thread_count(), [&](int) {
      ++held;
      while (!done)
        std::this_thread::yield();
    });
  });
  while (held == 0)
    std::this_thread::yield();
  start_workers(1 << 20);
  done = true;
  holder.join();
  start_workers(1 << 20);
  std::vector<int> squares(1000);
  for_each_task(std::ssize(squares), [&](std::int64_t i) {
    squares[static_cast<std::size_t>(i)] = static_cast<int>(i * i);
  });
  CHECK(std::accumulate(squares.begin(), squares.end(), 0) == 332833500);
}

#ifdef __linux__
namespace {

cpu_set_t only(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(processor, &set);
  return set;
}

} // namespace

TEST_CASE("a thread leaves the processor of another thread of its loop, and keeps its affinity") {
  cpu_set_t allowed;
  REQUIRE(sched_getaffinity(0, sizeof allowed, &allowed) == 0);
  const int processor = sched_getcpu();
  const cpu_set_t here = only(processor);
  REQUIRE(sched_setaffinity(0, sizeof here, &here) == 0);
  bool moved = CPU_COUNT(&allowed) == 1, kept = true;
  for (int attempt = 0; attempt < 100 && !moved; ++attempt) { // the system may move it back
    Placement placement(2);
    std::thread([&] { // inherits the affinity, so that it starts on the same processor
      sched_setaffinity(0, sizeof allowed, &allowed);
      placement.keep_apart();
      moved = sched_getcpu() != processor;
      cpu_set_t after;
      sched_getaffinity(0, sizeof after, &after);
      kept &= CPU_EQUAL(&after, &allowed) != 0;
    })
        .join();
  }
  CHECK(moved);
  CHECK(kept);

  Placement placement(2);
  bool stayed = false;
  std::thread([&] { // no other processor is allowed
    placement.keep_apart();
    cpu_set_t after;
    sched_getaffinity(0, sizeof after, &after);
    stayed = CPU_EQUAL(&after, &here) != 0 && sched_getcpu() == processor;
  })
      .join();
  CHECK(stayed);
  sched_setaffinity(0, sizeof allowed, &allowed);
}
#endif
