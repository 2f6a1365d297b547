// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace calotte::tools {

/// Prints "calotte: TEXT" on standard error, as one line: blanks replace its line ends.
void complain(std::string text);

/// Prints "calotte: warning: TEXT" on standard error; the same text only once.
void warn(const std::string& text);

} // namespace calotte::tools
