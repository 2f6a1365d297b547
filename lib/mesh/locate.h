// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "exact/space.h"
#include "mesh/room.h"

#include <calotte/locate.h>

namespace calotte::mesh_detail {

/// A caller's positions, in place.
/// \throws Error as Locator::find() for positions.
base_detail::Points3Ref checked_positions(const exact_detail::Sphere& sphere,
                                          const PointsRef& given);
base_detail::Points2Ref checked_positions(const exact_detail::Plane& plane, const PointsRef& given);

/// Requires positions of a surface. \throws Error as above.
void require_positions_of(const Surface& surface, const PointsRef& given);

/// Does what locate() does, but a position that is outside of an open mesh by rounding alone counts
/// as on its boundary: less than 1e-15 from it, in the plane of the largest coordinate. The nearest
/// site is that of positions without a triangle; -1 for all others.
Locations locate_within_rounding(const Mesh& mesh, const PointsRef& positions);

/// The nearest sites alone, in less time than locate().
Ids find_nearest(const Mesh& mesh, const PointsRef& positions);

} // namespace calotte::mesh_detail
