// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/room.h"
#include "domain/outline.h"
#include "domain/spherical_outline.h"

#include <calotte/mesh.h>
#include <calotte/surface.h>

/// Points outside a bounded surface. Triangulated together with them on the unbounded surface, all
/// sites inside have closed stars.
namespace calotte::delaunay_detail {

/// Directions that are not near the boundary of a region.
Points3 far_hull(const SphericalOutline& outline);

/// Three points far outside the box of a domain of the plane. No point inside the box is nearer to
/// one of them than to any other point inside.
Points3 far_hull(const Outline& outline);

/// The surface without its boundary.
Surface unbounded(const Surface& surface);

} // namespace calotte::delaunay_detail
