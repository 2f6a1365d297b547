// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/axes.h"
#include "draw/scale.h"

#include <cairo.h>

#include <string>
#include <vector>

namespace calotte::tools {

inline constexpr Rgb map_border_colour = {0.45, 0.48, 0.52}; ///< and the legend's

/// The meaning of the colours.
struct Legend {
  Scale scale;
  std::vector<ValenceClass> classes = {}; ///< of Colouring::valence
  std::string caption = {};
};

/// Round values along the colour bar: of angles (spacing, angle) in degrees, of numbers that are
/// very large or small in units of a power of ten.
struct BarTicks {
  AxisTicks ticks;
  int exponent = 0;
};

BarTicks bar_ticks(const Scale& scale, int most);

/// Draws the legend below y = top, centred on a page of that width; about 4 letters high.
void draw_legend(cairo_t* context, const Legend& legend, double page_width, double top,
                 double text);

} // namespace calotte::tools
