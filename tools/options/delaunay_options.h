// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <calotte/delaunay.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace calotte::tools {

/// The values of the options for regions and threads.
struct DelaunayWords {
  std::optional<int> threads, regions;
  std::string centres = "sample", sort = "halo", duplicates = "merge";
  double merge_within = 0;
};

/// Adds --threads, --regions, --centres, --sort, --duplicates and --merge-within.
std::shared_ptr<DelaunayWords> add_delaunay_options(CLI::App& command);

/// Adds --threads, 1 to 4096.
void add_threads(CLI::App& command, std::optional<int>& threads, const std::string& help);

DelaunayOptions options_of(const DelaunayWords& words);

/// Runs the work with that number of threads, or with all.
void with_threads(std::optional<int> threads, const std::function<void()>& work);

} // namespace calotte::tools
