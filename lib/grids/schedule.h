// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/cvt.h"
#include "grids/room.h"

#include <calotte/grid.h>

namespace calotte::grids_detail {

/// The options of the descents of a schedule; without the partition.
/// \pre the recipe has its choices made.
CvtOptions options_of(const Schedule& schedule);

} // namespace calotte::grids_detail
