// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "grids/room.h"
#include "grids/start.h"

#include <calotte/grid.h>

#include <vector>

namespace calotte::grids_detail {

/// The actions of a run, see cvt/stages.h.
/// \param recipe with all choices made, except the number of bisections.
/// \param on_lines number of its fixed generators on lines. \param on_boundary of those that the
///        mesh ends at.
std::vector<CvtAction> actions_of(const Recipe& recipe, const FirstLevel& first,
                                  std::int64_t on_lines = 0, std::int64_t on_boundary = 0);

} // namespace calotte::grids_detail
