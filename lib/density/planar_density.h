// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <calotte/density.h>
#include <calotte/domain.h>

namespace calotte::density_detail {

/// A density of a planar domain made ready for what speaks of columns (x, y, 0) alone: uniform, or
/// a callable that knows of the box's period.
/// \throws Error bad_option, when the density is ill-formed.
Density planar_density(const Density& density, const PlanarDomain& domain);

} // namespace calotte::density_detail
