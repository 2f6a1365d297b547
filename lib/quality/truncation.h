// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/room.h"

#include <calotte/quality.h>
#include <calotte/voronoi.h>

namespace calotte::quality_detail {

/// Sets the errors of the six operators and their values by cell, and off_midpoint, of a
/// tessellation of the sphere or of the plane.
void set_truncation(const Voronoi& of, OperatorErrors& out);

} // namespace calotte::quality_detail
