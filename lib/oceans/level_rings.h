// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oceans/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <span>
#include <vector>

namespace calotte::oceans_detail {

/// A point on an edge of a mesh, between a site whose value is not negative and one whose value is.
struct LevelPoint {
  std::int32_t above, below;
  double share; ///< of the way from the former to the latter, 0.05 to 0.95

  /// Linear between the values at the sites.
  double value(std::span<const double> values) const {
    return (1 - share) * values[static_cast<std::size_t>(above)] +
           share * values[static_cast<std::size_t>(below)];
  }
  /// A unit vector.
  Vec3 position(const Points3& sites) const {
    return normalised((1 - share) * column(sites, above) + share * column(sites, below));
  }
};

/// The closed rings on which a function, linear on the triangles of a mesh, is 0. Values that are
/// not negative are to the left. Each triangle has at most one segment of a ring, and each edge one
/// point, away from its ends: rings neither meet themselves nor each other.
/// \param mesh closed. \param values by site.
std::vector<std::vector<LevelPoint>> level_rings(const Mesh& mesh, std::span<const double> values);

} // namespace calotte::oceans_detail
