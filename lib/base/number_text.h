// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/room.h"

#include <cstdio>
#include <string>

namespace calotte::base_detail {

/// A number for messages, with six digits at most.
inline std::string shortly(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

} // namespace calotte::base_detail
