// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"
#include "domain/surface.h"

#include <calotte/density.h>
#include <calotte/types.h>

#include <cstdint>

/// Points outside a bounded surface. Generators inside together with these all have closed stars,
/// and the boundary clips their cells.
namespace calotte::cvt_detail {

/// Directions that are not near the boundary of a region.
Points3 far_hull(const SphericalOutline& outline);

/// Three points far outside the box of a domain of the plane. No point inside the box is nearer to
/// one of them than to any other point inside.
Points3 far_hull(const Outline& outline);

/// The far hull, and rows along the boundary at 4, 8, 16, ... times the spacing that a density
/// demands of so many generators there. Together with generators that are spread over the region,
/// they leave no hemisphere empty. All have few neighbours: with the far hull only, generators
/// along the boundary form flat triangles with each other, which overturn at every step.
/// \param surface a region of the sphere.
Points3 hull_of(const Surface& surface, const Density& density, std::int64_t generators);

} // namespace calotte::cvt_detail
