// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <calotte/planar_raster.h>

namespace calotte::density_detail {

/// \throws Error invalid_argument unless it meets the conditions of PlanarCellWidth.
void require_widths(const PlanarCellWidth& widths);

} // namespace calotte::density_detail
