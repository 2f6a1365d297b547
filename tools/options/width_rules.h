// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/widths.h>

#include <string>
#include <vector>

namespace calotte::tools {

/// What a rule says where it says nothing: wider than any other, in km.
inline constexpr double no_demand = 1e9;

struct WidthRules {
  Widths widths;
  double step = 0; ///< of their raster, as sampled() has it
};

/// Reads the table [cell-width] of a TOML file; see calotte help widths. Names of files are
/// relative to its folder. \throws Error parse, naming the line and the key; as the readers of the
/// files.
WidthRules read_width_rules(const std::string& path);

/// The files that rules name, without reading them.
std::vector<std::string> files_of_rules(const std::string& path);

} // namespace calotte::tools
