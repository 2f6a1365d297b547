// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"
#include "options/cvt_request.h"

#include <memory>

namespace calotte::tools {

/// Adds all options of `calotte cvt`.
std::shared_ptr<CvtRequest> add_cvt_options(CLI::App& command);

} // namespace calotte::tools
