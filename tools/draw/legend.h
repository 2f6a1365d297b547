// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/axes.h"
#include "draw/scale.h"

#include <cairo.h>

#include <functional>
#include <string>
#include <vector>

namespace calotte::tools {

inline constexpr Rgb map_border_colour = {0.45, 0.48, 0.52}; ///< and the legend's

/// The meaning of the colours.
struct Legend {
  Scale scale;
  std::vector<ValueClass> classes = {}; ///< where has_classes()
  std::string caption = {};
};

/// Round values along the colour bar: of numbers that are very large or small in units of a power
/// of ten. A value is its label times this power, plus the offset.
struct BarTicks {
  AxisTicks ticks;
  int exponent = 0;
  double offset = 0; ///< not 0 where labels would agree in their first three digits
};

BarTicks bar_ticks(const Scale& scale, int most);

/// The ticks of a bar on which no label touches another; as many labels as fit, at most 8.
/// \param gap between labels, in the unit of the width.
/// \param width_of a label, in the unit of the bar's width.
BarTicks fitted_ticks(const Scale& scale, double bar_width, double gap,
                      const std::function<double(const std::string&)>& width_of);

/// What the legend says of a scale that is constant: "constant 1.5", or "1.5 +- 1e-9" if the values
/// differ; marked text.
std::string constant_text(const Scale& scale);

/// Draws the legend below y = top, centred on a page of that width; about 4 letters high.
void draw_legend(cairo_t* context, const Legend& legend, double page_width, double top,
                 double text);

} // namespace calotte::tools
