// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"
#include "run/cvt_start.h"

#include <calotte/cvt.h>

#include <string>

namespace calotte::tools {

/// All input that determines the bits of the result, one line each; see write_checkpoint().
/// Threads, regions and files have no effect on them.
std::string configuration_of(const CvtRequest& request, const CvtOptions& options,
                             const CvtStart& start);

/// The same on one line, as provenance in output files: equal runs have equal lines.
std::string history_of(const std::string& configuration);

} // namespace calotte::tools
