// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"
#include "domain/planar_domain.h"

#include <calotte/density.h>

namespace calotte::density_detail {

/// Converts a density of a planar domain for functions that evaluate columns (x, y, 0): uniform, or
/// a callable that accounts for the period of the box.
/// \throws Error invalid_argument if the density is ill-formed.
Density planar_density(const Density& density, const PlanarDomain& domain);

} // namespace calotte::density_detail
