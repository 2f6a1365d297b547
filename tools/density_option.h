// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

namespace calotte::tools {

/// What the options say about a density.
struct DensityWords {
  std::vector<std::string>
      densities; ///< "uniform", or "tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x8"
  std::string join = "maximum"; ///< or "sum": what several bumps make
};

/// Adds --density (which may be given several times) and --join.
std::shared_ptr<DensityWords> add_density(CLI::App& command);

/// \throws Error bad_option naming the word and the remedy.
Density density_of(const DensityWords& words);

} // namespace calotte::tools
