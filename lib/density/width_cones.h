// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <calotte/widths.h>

namespace calotte::density_detail {

class WidthRule;

/// Lowers the widths at the nodes of a raster by the widths between them, so that a limit of the
/// gradient misses no minimum: a point y of width h lowers a node x within a step to h + g d(x, y).
/// The points y are the nodes of the rule's own raster; for other rules, those of a finer raster.
/// \param raster regular_grid() with the widths of the rule at its nodes.
/// \param gradient km per radian.
Raster with_cones(const WidthRule& rule, Raster raster, double gradient);

} // namespace calotte::density_detail
