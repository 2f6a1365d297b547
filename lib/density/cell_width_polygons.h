// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/lonlat.h"
#include "density/room.h"

#include <calotte/widths.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace calotte::density_detail {

using base_detail::LonLat;

/// At least three points; the last leads back to the first.
using Ring = std::vector<LonLat>;

/// The first ring and its holes: the interior is the set of points within an odd number of rings.
struct Polygon {
  std::vector<Ring> rings;
  std::optional<LonLat> inside = std::nullopt; ///< a point of the interior; by default the rings
                                               ///< enclose the side that enclose_left() tells
};

/// Polygons with one width inside, in km.
struct WidthRegion {
  double inside = 0;
  std::vector<Polygon> polygons;
};

/// See read_cell_width(). The outside width and the transition in `widths` are set. An inside width
/// may exceed the outside width only if there is one region.
/// \pre the points are finite, latitudes from -90 to 90.
/// \throws Error invalid_argument for a transition too narrow for the finest raster, or a ring that
///         runs round the Earth more than once.
Raster make_cell_width(const std::vector<WidthRegion>& regions, const PolygonWidths& widths);

} // namespace calotte::density_detail
