// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "generators/room.h"

#include <calotte/density.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cstdint>

namespace calotte::generators_detail {

/// boundary_points() without the limit by the number of generators.
Points3 all_boundary_points(const Surface& surface, std::int64_t cells, const Density& density);

} // namespace calotte::generators_detail
