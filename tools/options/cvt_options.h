// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"
#include "options/cvt_request.h"

#include <memory>
#include <set>
#include <string>

namespace calotte::tools {

/// Adds the options of `calotte cvt` that determine a run, and those of its threads.
std::shared_ptr<CvtRequest> add_run_options(CLI::App& command);

/// Adds all options of `calotte cvt`.
std::shared_ptr<CvtRequest> add_cvt_options(CLI::App& command);

/// The long names of these.
std::set<std::string> cvt_option_names();

} // namespace calotte::tools
