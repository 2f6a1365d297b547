// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/warning.h"

#include "text/text.h"

#include <algorithm>
#include <iostream>
#include <set>

#include <unistd.h>

namespace calotte::tools {

void complain(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::cerr << message("calotte: {}\n", text);
}

void warn(const std::string& text) {
  static std::set<std::string> printed; // a command may read its options several times
  if (!printed.insert(text).second)
    return;
  if (::isatty(STDERR_FILENO))
    std::cerr << "\r\033[K"; // clears the line of Progress
  complain("warning: " + text);
}

} // namespace calotte::tools
