// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <calotte/export.h>

#include <toml++/toml.h>

#include <string>

/// TOML for the library and its command. The header is not installed.
CALOTTE_API_BEGIN
namespace calotte {

/// Reads a TOML file.
/// \throws Error parse, with the line, for text that is not TOML or would take too much memory or
/// stack; file.
toml::table read_toml(const std::string& path);

} // namespace calotte
CALOTTE_API_END
