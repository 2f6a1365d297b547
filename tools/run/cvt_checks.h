// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"

namespace calotte::tools {

/// Rejects options that do not apply to the grid of --hexagons. \throws Error invalid_argument.
void require_hexagons(const CvtRequest& request);

/// Checks all options of a run that can fail, before any work.
/// \throws Error invalid_argument, file.
void require_request(const CvtRequest& request);

} // namespace calotte::tools
