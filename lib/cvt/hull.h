// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"
#include "domain/surface.h"

#include <calotte/density.h>
#include <calotte/mesh.h>

#include <cstdint>

/// Points outside a region beside its far hull, see delaunay/far_hull.h.
namespace calotte::cvt_detail {

/// Rows along the boundary at 4, 8, 16, ... times the spacing that a density demands of so many
/// generators there. Together with generators that are spread over the region, and the far hull,
/// they leave no hemisphere empty. All have few neighbours: with the far hull only, generators
/// along the boundary form flat triangles with each other, which overturn at every step.
/// \param surface a region of the sphere.
Points3 hull_rows(const Surface& surface, const Density& density, std::int64_t generators);

} // namespace calotte::cvt_detail
