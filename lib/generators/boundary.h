// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/demanded_spacing.h"
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
  std::vector<std::int32_t> next; ///< by point, the next one on its ring
};

/// boundary_points() without the limit by the number of generators.
BoundaryPoints all_boundary_points(const Surface& surface, std::int64_t cells,
                                   const Density& density);
/// The points of all_boundary_points(), and after them those that halve the gaps between them, so
/// many times, measured in the edges that the density demands.
/// \returns for each number of halvings from 0 on all points so far; those before keep their ids.
std::vector<BoundaryPoints> halved_boundary_points(const Surface& surface, std::int64_t cells,
                                                   const Density& density, int halvings);
/// all_boundary_points() with the limit. \throws Error as boundary_points().
BoundaryPoints limited_boundary_points(const Surface& surface, std::int64_t cells,
                                       const Density& density);

/// Generators along a part of a boundary, as boundary_points() has them: between its ends, which
/// stay, or along a whole ring.
/// \param corners two or more of the boundary, with the surface to the left.
std::vector<Vec3> points_along_boundary(const Surface& surface, const std::vector<Vec3>& corners,
                                        bool closed, const DemandedSpacing& spacing);

} // namespace calotte::generators_detail
