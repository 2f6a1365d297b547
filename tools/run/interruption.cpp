// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/interruption.h"

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <ctime>

namespace calotte::tools {
namespace {

std::atomic<int> noted = 0;
std::atomic<std::int64_t> noted_at = 0; ///< nanoseconds
static_assert(std::atomic<int>::is_always_lock_free &&
                  std::atomic<std::int64_t>::is_always_lock_free,
              "a handler of signals may use nothing else");

std::int64_t nanoseconds() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// Terminals, shells, timeout and schedulers may send several signals at once.
extern "C" void calotte_note_signal(int signal) {
  constexpr std::int64_t together = 1'000'000'000;
  const int error = errno;
  if (noted == 0) {
    noted_at = nanoseconds();
    noted = signal;
  } else if (nanoseconds() - noted_at > together) {
    std::signal(signal, SIG_DFL);
    std::raise(signal); // delivered when this handler returns
  }
  errno = error;
}

} // namespace

Interruption::Interruption() {
  noted = 0;
  struct sigaction action = {};
  action.sa_handler = calotte_note_signal;
  action.sa_flags = SA_RESTART; // a write in progress continues
  ::sigaction(SIGINT, &action, &before_interrupt_);
  ::sigaction(SIGTERM, &action, &before_terminate_);
}

Interruption::~Interruption() {
  // The process ends: another signal within the second must not change its exit code.
  if (noted != 0)
    return;
  ::sigaction(SIGINT, &before_interrupt_, nullptr);
  ::sigaction(SIGTERM, &before_terminate_, nullptr);
}

int Interruption::signal() { return noted; }

} // namespace calotte::tools
