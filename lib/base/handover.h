// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace calotte::base_detail {

/// Tells ThreadSanitizer what it cannot see, since Debian's libtbb is not built for it: all that
/// precedes a parallel loop happens before each of its bodies, and each body before all that
/// follows the loop. Two bodies stay unordered, so races between them are still found. In other
/// builds it does nothing.
class Handover {
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
