// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "generators/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

namespace calotte::generators_detail {

/// Lines as one network. It does not depend on how the lines are cut into parts, and contains
/// shared parts of lines once.
struct LineNetwork {
  std::vector<Vec3> points;    ///< distinct; unit vectors on the sphere
  std::vector<int> neighbours; ///< of each point: 1 at an end, 3 or more at a confluence
  /// Chains from an end or confluence to the next one, or around a loop that has neither, as
  /// indices of two or more points. A single point is a chain of one.
  std::vector<std::vector<std::int32_t>> chains;
};

/// \param lines each 3 x n; directions on the sphere. \param sphere whether they lie on the sphere;
/// else in the plane.
/// \throws Error invalid_argument as domain_detail::checked_line().
LineNetwork make_network(const std::vector<Points3>& lines, bool sphere);

} // namespace calotte::generators_detail
