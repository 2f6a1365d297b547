// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

#include <calotte/cell_width.h>

#include <cstdint>
#include <vector>

namespace calotte::density_detail {

/// Degrees.
struct Place {
  double longitude = 0, latitude = 0;
};

/// At least three places; the last leads back to the first.
using Ring = std::vector<Place>;

/// The first ring and its holes: what lies within an odd number of its rings.
using Polygon = std::vector<Ring>;

/// Polygons with one width inside, in km.
struct WidthRegion {
  double inside = 0;
  std::vector<Polygon> polygons;
};

/// See read_cell_width. All widths but each region's own are given. Only where there is one region
/// may it be wider than the outside. \pre the places are finite, latitudes from -90 to 90.
/// \throws Error bad_option, for a transition too narrow for the finest raster; a ring that runs
///         round the Earth more than once.
CellWidth cell_width_of(const std::vector<WidthRegion>& regions, const PolygonWidths& widths);

} // namespace calotte::density_detail
