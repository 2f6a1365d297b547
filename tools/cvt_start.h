// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "commands.h"
#include "cvt_request.h"

#include <string>

namespace calotte::tools {

/// Where a run starts.
struct CvtStart {
  PointFile file; ///< the points; name and lines when they come from a file
  int bisections = 0;
  std::string note; ///< what the user ought to know of it, or ""
  /// What determines it, for the run's configuration: lines "name value".
  std::string configuration;
};

/// Refuses, before any work, what the options say of the start.
/// \throws Error bad_option.
void require_start(const CvtRequest& request);

/// Makes or reads the points.
/// \throws Error bad_option, parse, file.
CvtStart make_start(const CvtRequest& request, const Density& density);

} // namespace calotte::tools
