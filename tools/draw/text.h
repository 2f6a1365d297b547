// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/scale.h"

#include <cairo.h>

#include <cstdint>
#include <string>

namespace calotte::tools {

inline constexpr Rgb text_colour = {0.13, 0.15, 0.19};

void set_colour(cairo_t* context, const Rgb& colour);

/// The font of all text, in letters of this size.
void select_font(cairo_t* context, double size);

double text_width(cairo_t* context, const std::string& text);

/// One line of text whose middle is at x.
void centred_text(cairo_t* context, double x, double baseline, const std::string& text);

/// One line of text centred at x, in letters of this size, or smaller to fit the width.
void fitted_text(cairo_t* context, double x, double baseline, const std::string& text, double size,
                 double room);

/// A number with groups of three digits: 2621442 as 2 621 442.
std::string grouped(std::int64_t number);

/// A number's text with the sign for minus in place of a hyphen.
std::string with_minus(const std::string& text);

/// "10^{-3}", marked text.
std::string power_of_ten(int exponent);

/// A number with at most this many digits, marked text: 1.5, 6.4 x 10^{21}.
std::string number_text(double value, int digits);

/// Converts a file's text or name to text that can be shown.
std::string shown(const std::string& text);

/// Converts text to marked text without marks.
std::string unmarked(const std::string& text);

/// Whether a file's units name one, unlike those of a ratio ("1").
bool is_unit(const std::string& units);

/// Converts units in the style of files to marked text: exponents, as in "m s-1", are raised.
std::string unit_text(const std::string& units);

/// The length of a line of marked text: `*h*` is in italics, `_{i}` lowered, `^{2}` raised.
double marked_width(cairo_t* context, const std::string& text);

/// One line of marked text.
/// \param align the part of it that stands left of x: 0, 0.5 for its middle, 1.
/// \return where it ends.
double marked_text(cairo_t* context, double x, double baseline, const std::string& text,
                   double align = 0);

} // namespace calotte::tools
