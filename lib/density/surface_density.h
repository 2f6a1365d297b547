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

/// A density of widths or a callable as a callable; empty for others.
Density::Callable make_callable(const Density& density);

/// The density in the form that the rooms above evaluate: on the sphere itself; in a plane uniform,
/// of widths, or a callable of columns (x, y, 0) that accounts for the periods.
/// \throws Error invalid_argument in a plane, if bumps are ill-formed.
Density surface_density(const Density& density, const Surface& surface);

/// The same, evaluated at one point, so that an ill-formed density is refused before any work.
/// \throws Error invalid_argument.
Density checked_surface_density(const Density& density, const Surface& surface);

} // namespace calotte::density_detail
