// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <string>

namespace calotte::tools {

/// Reads a file of TOML.
/// \throws Error parse for a text that is none, or would take much memory or stack, with its line;
///         file.
toml::table read_toml(const std::string& path);

/// \throws Error parse, always: "PATH line LINE: problem".
[[noreturn]] void refuse_line(const std::string& path, std::int64_t line,
                              const std::string& problem);

} // namespace calotte::tools
