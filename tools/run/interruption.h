// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <csignal>

namespace calotte::tools {

/// During its lifetime, the first SIGINT or SIGTERM is recorded instead of ending the process.
/// Others within a second count as the same, also after the lifetime; a later one ends the process
/// at once. One object at a time.
class Interruption {
public:
  Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// The signal received, or 0.
  static int signal();

private:
  struct sigaction before_interrupt_ = {}, before_terminate_ = {};
};

} // namespace calotte::tools
