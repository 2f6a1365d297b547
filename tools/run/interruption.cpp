// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/interruption.h"

#include <atomic>

namespace calotte::tools {
namespace {

std::atomic<int> noted = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a handler of signals may use nothing else");

extern "C" void calotte_note_signal(int signal) {
  noted = signal;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
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
  ::sigaction(SIGINT, &before_interrupt_, nullptr);
  ::sigaction(SIGTERM, &before_terminate_, nullptr);
}

int Interruption::signal() { return noted; }

} // namespace calotte::tools
