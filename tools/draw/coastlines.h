// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"

#include <vector>

namespace calotte::tools {

/// The coastlines of the earth at a scale of 1:110 million, longitudes and latitudes in degrees to
/// two decimals. An island's line ends where it begins. Longitudes are continuous along a line, and
/// so may be beyond -180 and 180; neighbours are at most 20 degrees apart in each coordinate.
std::vector<std::vector<LonLat>> coastlines();

} // namespace calotte::tools
