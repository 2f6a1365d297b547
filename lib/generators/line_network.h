// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "generators/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

namespace calotte::generators_detail {

/// Lines as one network: how they are cut into parts does not matter, and what several of them
/// share is there once.
struct LineNetwork {
  std::vector<Vec3> points;    ///< distinct; unit vectors on the sphere
  std::vector<int> neighbours; ///< of each point: 1 at an end, 3 or more at a confluence
  /// Ways from an end or confluence to the next one, or round a loop that has neither: indices of
  /// points, two or more; of a single point one.
  std::vector<std::vector<std::int32_t>> chains;
};

/// \param lines each 3 x n, on the sphere directions. \param sphere or in the plane.
/// \throws Error invalid_argument as domain_detail::checked_line().
LineNetwork make_network(const std::vector<Points3>& lines, bool sphere);

} // namespace calotte::generators_detail
