// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace calotte::tools {

/// One value of a file, in the syntax of the command line.
struct ConfigValue {
  enum class Kind { truth, number, text };
  Kind kind = Kind::text;
  std::string text; ///< "true" or "false" for a truth; numbers with the fewest digits
};

/// The setting of one key in a file.
struct ConfigSetting {
  std::string key;
  std::int64_t line = 0;           ///< 1-based
  std::vector<ConfigValue> values; ///< at least one; several from an array
};

/// Reads a TOML file, its settings in the order of their lines. Tables may group the keys, one
/// deep; their names mean nothing. \throws Error file; parse (index() is the line) for what is no
/// TOML, and for dates, tables within
///         tables, arrays of arrays or tables, and empty arrays.
std::vector<ConfigSetting> read_config(const std::string& path);

} // namespace calotte::tools
