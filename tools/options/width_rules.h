// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

struct WidthRules {
  Widths widths;
  double step = 0; ///< of their raster, as sampled() has it
  /// Of a plane: the limit of all of it, which is that of the raster in its domain.
  std::optional<double> gradient = {};
  std::vector<std::string> names = {}; ///< of the rules that active_rules() numbers
};

/// Reads the table [cell-width] of a TOML file; see calotte help widths. Names of files are
/// relative to its folder.
/// \param surface the sphere or a plane, which the rules are of.
/// \throws Error parse, naming the line and the key; as the readers of the files.
WidthRules read_width_rules(const std::string& path, const Surface& surface = {});

/// Where a rule gives the width.
struct RuleShare {
  std::string name;
  double area, cells; ///< shares of those of the surface, 0 to 1
};

/// Of each rule of a minimum, within about 1/1000.
/// \param surface the sphere or a region of it.
/// \param density that the rules demand.
std::vector<RuleShare> rule_shares(const WidthRules& rules, const Surface& surface,
                                   const Density& density);

/// What a file of rules says of itself.
struct RulesOutline {
  std::vector<std::string> files; ///< that its rules name
  std::optional<double> gradient; ///< the limit of all of it
};

/// Reads the TOML file alone. \throws Error parse; file.
RulesOutline outline_of_rules(const std::string& path);

} // namespace calotte::tools
