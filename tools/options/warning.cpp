// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/warning.h"

#include <iostream>
#include <set>

#include <unistd.h>

namespace calotte::tools {

void warn(const std::string& text) {
  static std::set<std::string> printed; // a command may read its options several times
  if (!printed.insert(text).second)
    return;
  const char* const clear = ::isatty(STDERR_FILENO) ? "\r\033[K" : ""; // the line of Progress
  std::cerr << clear + ("calotte: warning: " + text + "\n");
}

} // namespace calotte::tools
