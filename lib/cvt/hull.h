// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"
#include "domain/surface.h"

#include <calotte/density.h>
#include <calotte/mesh.h>

#include <cstdint>

/// Points outside a region beside its far hull, see delaunay/far_hull.h.
namespace calotte::cvt_detail {

/// Rows of points along the boundary, at distances of 4, 8, 16, ... times the spacing that a
/// density demands there of so many generators. With generators spread over the region and with the
/// far hull, they leave no hemisphere empty. Each point has few neighbours. With the far hull only,
/// generators along the boundary would form flat triangles with each other, which overturn at every
/// step.
/// \param surface a region of the sphere.
Points3 hull_rows(const Surface& surface, const Density& density, std::int64_t generators);

} // namespace calotte::cvt_detail
