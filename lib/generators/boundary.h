// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "generators/room.h"

#include <calotte/density.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cstdint>
#include <vector>

namespace calotte::generators_detail {

/// The result of boundary_points(), ring by ring.
struct BoundaryPoints {
  Points3 points;
  std::vector<std::int64_t> ring_ends; ///< by ring, the number of points up to its end
};

/// boundary_points() without the limit by the number of generators.
BoundaryPoints all_boundary_points(const Surface& surface, std::int64_t cells,
                                   const Density& density);
/// The same with it. \throws Error as boundary_points().
BoundaryPoints limited_boundary_points(const Surface& surface, std::int64_t cells,
                                       const Density& density);

} // namespace calotte::generators_detail
