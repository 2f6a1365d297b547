// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"
#include "run/cvt_start.h"

#include <calotte/cvt.h>

#include <string>

namespace calotte::tools {

/// All that determines the bits of the result, a line each; see write_checkpoint. Threads, regions
/// and files do not.
std::string configuration_of(const CvtRequest& request, const CvtOptions& options,
                             const CvtStart& start);

/// The same in one line, for files that tell how they were made: equal runs have equal ones.
std::string history_of(const std::string& configuration);

} // namespace calotte::tools
