// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <calotte/export.h>

#include <toml++/toml.h>

#include <string>

/// TOML for the library and its command. The header is not installed.
CALOTTE_API_BEGIN
namespace calotte {

/// Reads a file of TOML.
/// \throws Error parse for a text that is none, or would take much memory or stack, with its line;
///         file.
toml::table read_toml(const std::string& path);

} // namespace calotte
CALOTTE_API_END
