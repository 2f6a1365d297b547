// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/regions.h"
#include "delaunay/room.h"
#include "delaunay/sites.h"

#include <calotte/types.h>

namespace calotte::delaunay_detail {

/// The stages after divide(), on the sphere: the Delaunay triangulation of sites for a caller that
/// already has their regions.
/// \throws Error degenerate for sites on one great circle.
Mesh spherical_mesh(Sites&& sites, Regions&& regions);

} // namespace calotte::delaunay_detail
