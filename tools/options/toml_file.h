// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <toml++/toml.h>

#include <string>

namespace calotte::tools {

/// Reads a file of TOML.
/// \throws Error parse for a text that is none, or would take much memory or stack, with its line;
///         file.
toml::table read_toml(const std::string& path);

} // namespace calotte::tools
