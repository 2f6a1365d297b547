// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw_scale.h"
#include "draw_shapes.h"

#include <cairo.h>

#include <vector>

namespace calotte::tools {

/// A scene with what fills its shapes.
struct Painting {
  Scene scene;
  std::vector<double> values; ///< by shape; NaN: not painted
  std::vector<float> widths;  ///< by shape, on the unit sphere
  Scale scale;
};

inline constexpr Rgb globe_colour = {0.965, 0.97, 0.975}; ///< where no shape is
inline constexpr Rgb line_colour = {0.07, 0.09, 0.13};

/// Shapes that face the viewer at least in part.
std::int64_t visible_shapes(const Painting& painting);

/// The globe in an image of side 2 * radius, whose pixels average 1 to 16 samples each; a sample
/// lies in exactly one shape, so no seam shows, and the cost hardly depends on the number of
/// shapes.
cairo_surface_t* raster_globe(const Painting& painting, int radius);

/// The globe in paths, around the origin; the current transformation must be the identity but for a
/// translation.
void vector_globe(cairo_t* context, const Painting& painting, double radius);

} // namespace calotte::tools
