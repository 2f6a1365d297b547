// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/scale.h"

#include <cairo.h>

#include <functional>
#include <string>
#include <vector>

namespace calotte::tools {

/// Maps a quantity to positions along a side of a frame.
struct Axis {
  double low = 0, high = 1; ///< low < high; both > 0 where logarithmic
  bool logarithmic = false;

  double position(double value) const; ///< 0 at low, 1 at high; beyond them for values beyond
  bool shows(double value) const; ///< true if the value has a position: finite, > 0 if logarithmic
};

/// The axis of the values that it can show, with a margin at both ends of this fraction of their
/// range; from 0 (or 0.1) to 1 if it can show none.
Axis axis_around(const std::vector<double>& values, bool logarithmic, double margin = 0.04);

struct Tick {
  double position = 0; ///< on an axis or a colour bar, 0 to 1
  std::string label;
};

/// Round values along an axis: those with a label (marked text), and the positions of the others.
struct AxisTicks {
  std::vector<Tick> labelled;
  std::vector<double> unlabelled;
};

/// \param most maximum number of labels, >= 2; fewer than two only if the axis has no more round
///         values.
AxisTicks ticks_of(const Axis& axis, int most);

/// A point on the page, y downwards.
struct PagePoint {
  double x = 0, y = 0;
};

/// A rectangle of the page in which data stand.
struct Frame {
  double left = 0, top = 0, width = 0, height = 0;
  Axis across, up;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
  PagePoint at(double x, double y) const {
    return {left + across.position(x) * width, bottom() - up.position(y) * height};
  }
};

/// The style of a frame's axes.
struct AxesLook {
  double text = 12;        ///< font size; lines and ticks scale with it
  std::string across = {}; ///< the axes' names, marked text
  std::string up = {};
  int most_across = 8; ///< labels along an axis; 0 for an axis without ticks
  int most_up = 7;
  bool across_labels = true; ///< false if the frame below has them
  double up_labels = 3.2;    ///< minimum width of the labels of `up`, in letters
};

/// Faint lines at the labelled ticks: beneath the data.
void draw_grid(cairo_t* context, const Frame& frame, const AxesLook& look);

/// The border, ticks, labels and names: above the data.
void draw_axes(cairo_t* context, const Frame& frame, const AxesLook& look);

/// Calls `paint`, clipped to the frame.
void inside(cairo_t* context, const Frame& frame, const std::function<void()>& paint);

/// Strokes the line through the points, with a gap at points that cannot be shown; a point between
/// two gaps becomes a dot. Colour, width and dashes are those of the context.
void draw_curve(cairo_t* context, const Frame& frame, const std::vector<double>& x,
                const std::vector<double>& y);

} // namespace calotte::tools
