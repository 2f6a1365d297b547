// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/lonlat.h"
#include "base/vec3.h"
#include "io/cells/room.h"

#include <vector>

namespace calotte::io_detail {

/// The outline of a convex cell of the sphere in the plane of longitude and latitude, as RFC 7946
/// (Butler et al., 2016, Sect. 3.1) requires: rings run counter-clockwise, and the first point is
/// not repeated. A cell that the meridian of 180 degrees cuts has two rings (Sect. 3.1.9). A cell
/// around a pole has one ring that runs along that meridian to the edge of the plane at the pole
/// and back. An edge is cut where its arc meets the meridian, so that neighbours agree to the last
/// bit.
/// \param corners unit vectors counter-clockwise seen from outside. Corners within 1e-12 of a pole
///        count as the pole; equal corners count once.
/// \returns no ring for fewer than three points.
std::vector<std::vector<LonLat>> cell_outline(const std::vector<Vec3>& corners);

} // namespace calotte::io_detail
