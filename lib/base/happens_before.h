// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace calotte::base_detail {

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

} // namespace calotte::base_detail
