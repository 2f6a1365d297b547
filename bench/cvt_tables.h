// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density_cost.h"
#include "report.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace calotte::bench {

/// Markdown: for each set the seconds of the rows, their ratios to `base` and the composition of an
/// iteration; then the cost of each row per site relative to the smallest set of the same name.
void print_iterations(std::ostream& out, const std::vector<SetResults>& results,
                      const std::string& base);

/// Markdown: nanoseconds an evaluation, for each length of the rows.
void print_density_costs(std::ostream& out, const std::vector<DensityCost>& costs);

} // namespace calotte::bench
