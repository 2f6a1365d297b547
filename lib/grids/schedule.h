// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/options.h"
#include "grids/room.h"

#include <calotte/grid.h>

namespace calotte::grids_detail {

/// The options of the descents of a schedule; without the partition.
/// \param bisections that its actions hold. \pre the recipe has its choices made.
CvtOptions options_of(const Schedule& schedule, int bisections = 0);

} // namespace calotte::grids_detail
