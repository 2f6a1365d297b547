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

/// The far hull, and rows along the boundary at 4, 8, 16, ... times the spacing that a density
/// demands of so many generators there. Together with generators that are spread over the region,
/// they leave no hemisphere empty. All have few neighbours: with the far hull only, generators
/// along the boundary form flat triangles with each other, which overturn at every step.
/// \param surface a region of the sphere.
Points3 hull_of(const Surface& surface, const Density& density, std::int64_t generators);

} // namespace calotte::cvt_detail
