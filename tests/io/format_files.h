// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/write.h>

#include <string>

namespace calotte::test {

/// The name of a file, and its format.
struct FormatFile {
  std::string name;
  Format format;
};

} // namespace calotte::test
