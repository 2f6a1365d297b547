// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/surface.h>

#include <array>
#include <string>

namespace calotte::tools {

/// Bounds of a surface: longitudes and latitudes in degrees, or x and y. They end where they began,
/// or less than 360 degrees to the east of it; west may be greater than east.
struct Extent {
  std::array<double, 2> x{}, y{}; ///< from, to
  bool all_around = false;        ///< all longitudes: a ring or the region surrounds the axis
};

/// The extent of a bounded surface or of a box. \pre it is one of these.
Extent extent_of(const Surface& surface);

/// "117.0 W to 93.0 W, 31.0 N to 49.0 N", or in a plane "x 0 to 9, y 0 to 5".
std::string words_of(const Extent& extent, bool on_sphere);

} // namespace calotte::tools
