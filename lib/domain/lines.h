// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "domain/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

namespace calotte::domain_detail {

/// The points of a line: unit vectors joined by arcs shorter than a half circle, or x y 0 of a
/// plane joined by straight lines. Consecutive points may be equal.
/// \param line 3 x n. \param number index of the line, for messages.
/// \throws Error invalid_argument, naming line and point: no direction, or no point of a plane;
///         opposite neighbours on the sphere.
std::vector<Vec3> checked_line(const Points3& line, std::int64_t number, bool sphere);

} // namespace calotte::domain_detail
