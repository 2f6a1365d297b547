// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <calotte/density.h>
#include <calotte/surface.h>

namespace calotte::density_detail {

/// Whether a density is made of bumps.
inline bool has_bumps(const Density& density) {
  return density.kind == Density::Kind::maximum || density.kind == Density::Kind::sum;
}

/// The callable of a density that is one or is given by widths; empty for other densities.
Density::Callable make_callable(const Density& density);

/// The density in the form that the rooms above evaluate. On the sphere it is unchanged. In a plane
/// it is uniform, given by widths, or a callable of columns (x, y, 0) that accounts for the
/// periods.
/// \throws Error invalid_argument in a plane, if bumps are ill-formed.
Density surface_density(const Density& density, const Surface& surface);

/// The same, evaluated at one point first, so that an ill-formed density is refused before any
/// work.
/// \throws Error invalid_argument.
Density checked_surface_density(const Density& density, const Surface& surface);

} // namespace calotte::density_detail
