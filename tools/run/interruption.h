// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <csignal>

namespace calotte::tools {

/// While it lives, the first SIGINT or SIGTERM is noted instead of ending the process; a second one
/// ends it at once. One at a time.
class Interruption {
public:
  Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// The signal that came, or 0.
  static int signal();

private:
  struct sigaction before_interrupt_ = {}, before_terminate_ = {};
};

} // namespace calotte::tools
