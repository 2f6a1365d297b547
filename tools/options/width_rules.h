// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/widths.h>

#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

struct WidthRules {
  Widths widths;
  double step = 0; ///< of their raster, as sampled() has it
};

/// Reads the table [cell-width] of a TOML file; see calotte help widths. Names of files are
/// relative to its folder. \throws Error parse, naming the line and the key; as the readers of the
/// files.
WidthRules read_width_rules(const std::string& path);

/// What a file of rules says of itself.
struct RulesOutline {
  std::vector<std::string> files; ///< that its rules name
  std::optional<double> gradient; ///< the limit of all of it
};

/// Reads the TOML file alone. \throws Error parse; file.
RulesOutline outline_of_rules(const std::string& path);

} // namespace calotte::tools
