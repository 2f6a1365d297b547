// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density_cost.h"
#include "report.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace calotte::bench {

/// Markdown: for each set the rows' seconds and their ratios to `base`, and what an iteration is
/// made of; then each row's cost a site against the smallest set of the same name.
void print_iterations(std::ostream& out, const std::vector<SetResults>& results,
                      const std::string& base);

/// Markdown: nanoseconds an evaluation, for each length of the rows.
void print_density_costs(std::ostream& out, const std::vector<DensityCost>& costs);

} // namespace calotte::bench
