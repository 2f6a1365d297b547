// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"

#include <doctest/doctest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

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
