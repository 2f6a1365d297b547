// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "domain/room.h"

#include <calotte/surface.h>

namespace calotte::domain_detail {

/// Whether the boundary of a surface may come within a distance of a point: false is certain.
/// \param point unit vector, in a plane x y 0. \param reach radians, in a plane its unit.
bool is_near_boundary(const Surface& surface, const Vec3& point, double reach);

} // namespace calotte::domain_detail
