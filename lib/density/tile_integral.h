// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"
#include "density/width_tiles.h"

#include <calotte/surface.h>

namespace calotte::density_detail {

/// The integral of 1/h^2 over a surface that tiles cover: on the unit sphere, or of the plane. It
/// is a sum over boxes. A box is halved while the boundary crosses it and it is large compared with
/// the surface.
double integral_in(const WidthTiles& tiles, const Surface& surface);

} // namespace calotte::density_detail
