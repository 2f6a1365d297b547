// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/room.h"

#include <calotte/locate.h>

namespace calotte::mesh_detail {

/// As locate(), but a position that is outside of an open mesh by rounding alone is on its
/// boundary: less than 1e-15 from it, in the plane of the largest coordinate.
Locations locate_within_rounding(const Mesh& mesh, const PointsRef& positions);

} // namespace calotte::mesh_detail
