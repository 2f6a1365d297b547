// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <calotte/density.h>
#include <calotte/surface.h>

namespace calotte::density_detail {

/// The density in the form that the rooms above evaluate: on the sphere itself; in a plane uniform,
/// or a callable of columns (x, y, 0) that accounts for the periods.
/// \throws Error invalid_argument if the density is ill-formed.
Density surface_density(const Density& density, const Surface& surface);

} // namespace calotte::density_detail
