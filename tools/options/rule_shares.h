// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/read.h>
#include <calotte/surface.h>

#include <string>
#include <vector>

namespace calotte::tools {

/// Where a rule gives the width.
struct RuleShare {
  std::string name;
  double area, cells; ///< shares of those of the surface, 0 to 1
};

/// Estimates the shares of each rule of a minimum, within about 1/1000.
/// \param surface the sphere or a region of it.
/// \param density that the rules demand.
std::vector<RuleShare> rule_shares(const WidthRules& rules, const Surface& surface,
                                   const Density& density);

} // namespace calotte::tools
