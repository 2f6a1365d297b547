// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "grids/room.h"
#include "grids/start.h"

#include <calotte/grid.h>

#include <vector>

namespace calotte::grids_detail {

/// The actions of a run, see cvt/stages.h.
/// \param recipe with all choices made, except the number of bisections.
/// \param has_lines whether some of its fixed generators are on lines.
std::vector<CvtAction> actions_of(const Recipe& recipe, const FirstLevel& first,
                                  bool has_lines = false);

} // namespace calotte::grids_detail
