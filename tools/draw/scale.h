// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace calotte::tools {

/// Red, green and blue, each 0 to 1, sRGB.
struct Rgb {
  double r = 0, g = 0, b = 0;
};

/// The colour of 0xrrggbb.
inline Rgb colour_of(std::uint32_t rgb) {
  const auto channel = [rgb](int shift) { return ((rgb >> shift) & 0xff) / 255.0; };
  return {channel(16), channel(8), channel(0)};
}

/// 0xrrggbb of a colour.
inline std::uint32_t bytes_of(const Rgb& c) {
  const auto byte = [](double x) { return static_cast<std::uint32_t>(std::lround(255 * x)); };
  return byte(c.r) << 16 | byte(c.g) << 8 | byte(c.b);
}

/// Maps values, in the unit of the legend, to colours.
struct Scale {
  Colouring colouring = Colouring::none;
  Palette palette = Palette::viridis;
  double low = 0, high = 1;       ///< the values at the colour bar's ends
  double least = 0, greatest = 1; ///< the extreme values
  bool constant = false;          ///< true if they differ by at most a millionth: one colour
  ScaleKind kind = ScaleKind::automatic;
  bool logarithmic = false;
  bool degrees = false;              ///< of values that are degrees
  bool below = false, above = false; ///< true if values beyond an end have the colour of the end

  /// The position of a value on the bar, 0 to 1.
  double position(double value) const;
  Rgb colour(double value) const;
};

/// A scale for these values, NaN excluded. Its ends are the extreme values, unless the outermost
/// hundredth at an end would take more than a fifth of it. Automatically it is logarithmic for
/// values above 0 of a wide range: spacings, areas and densities of which the greatest is more than
/// 4 times the least, and fields whose quantiles of 1 and 99% differ by a factor above 1000.
Scale make_scale(const std::vector<double>& values, Colouring colouring,
                 ScaleKind kind = ScaleKind::automatic);

/// Makes the colour bar that of a range.
/// \throws Error invalid_argument for a colouring that has no colour bar.
void set_range(Scale& scale, const ColourRange& range);

/// The scale of a picture, with the palette, the range and the kind that are asked for.
/// \throws Error invalid_argument as set_range(), and for a logarithmic scale of values that are
/// not
///         above 0.
Scale make_scale(const std::vector<double>& values, Colouring colouring, const Look& look);

/// Whether the values are a few classes of a colour each, with a legend of these.
bool has_classes(Colouring colouring);

/// The palettes by the words of --palette.
const std::vector<std::pair<std::string, Palette>>& palette_names();

/// The colours of a colour bar at equal steps: viridis and magma (van der Walt and Smith, 2015),
/// cividis (Nunez, Anderton and Renslow, 2018), or from blue over grey to red.
std::vector<Rgb> palette_colours(Palette palette);

/// The colour of a colour bar from 0 to 1.
Rgb palette_colour(Palette palette, double position);

/// Six hexadecimal digits.
std::string hex_text(const Rgb& colour);

/// The value of a cell that the boundary of a plane clips, in place of its number of neighbours.
inline constexpr double boundary_valence = 0;

/// The colour of a number of neighbours, or of a value of bdyMaskCell.
Rgb class_colour(Colouring colouring, double value);

/// One class of values: its colour, its name, its number of shapes.
struct ValueClass {
  Rgb colour;
  std::string label;
  std::int64_t count = 0;
};

/// The classes that occur, in rising order; the boundary of valences is the first. None unless
/// has_classes().
std::vector<ValueClass> classes_of(const std::vector<double>& values, Colouring colouring);

} // namespace calotte::tools
