// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/painting.h"

#include <cairo.h>

namespace calotte::tools {

/// Pixels of a map.
struct MapSize {
  int width = 0, height = 0;
};

/// The largest map of at most that width with an even number of pixels in both directions.
MapSize map_size(Projection projection, int width);

/// A window of the map in an image of this size, whose pixels average 1 to 16 samples each; a
/// sample lies in exactly one shape, so no seam shows, and the cost hardly depends on the number of
/// shapes. Transparent beyond the map.
cairo_surface_t* raster_map(const Painting& painting, const MapWindow& window, const MapSize& size);

/// A field, evaluated at up to four samples a pixel.
struct FieldPainting {
  std::function<DoubleVector(const Points3& x)> values;
  Scale scale;
  Eigen::Matrix3d frame; ///< from points on the earth to directions of the scene
};

cairo_surface_t* raster_map(const FieldPainting& painting, const MapWindow& window,
                            const MapSize& size);

} // namespace calotte::tools
