// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"
#include "run/cvt_input.h"

#include <calotte/cvt.h>

#include <string>

namespace calotte::tools {

/// All input that determines the course of a run, one line each; see write_checkpoint(). Threads,
/// regions and files have no effect on it, and a resumed run may stop by another rule.
std::string configuration_of(const CvtRequest& request, const CvtInput& input,
                             const Schedule& schedule);

/// The same and the stopping rule on one line, as provenance in output files: equal runs have equal
/// lines. A run that did not converge says so.
std::string history_of(const CvtRequest& request, const CvtStop& stop,
                       const std::string& configuration, const CvtReport& report);

} // namespace calotte::tools
