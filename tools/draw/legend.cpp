// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/legend.h"

#include "draw/text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calotte::tools {

namespace {

bool is_angle(const Scale& scale) {
  return (scale.colouring == Colouring::spacing && !scale.lengths) ||
         scale.colouring == Colouring::angle;
}

/// The power of ten that is factored out to shorten the labels.
int common_exponent(const Axis& axis) {
  const double greatest = std::max(std::abs(axis.low), std::abs(axis.high));
  const bool by_powers = axis.logarithmic && axis.high >= 100 * axis.low;
  if (by_powers || !(greatest > 0)) {
    return 0;
  }
  const auto exponent = static_cast<int>(std::floor(std::log10(greatest)));
  return exponent >= 5 || exponent < -2 ? exponent : 0;
}

/// The layout of the bar.
struct Bar {
  double left, top, width, height;
  double bottom() const { return top + height; }
};

/// The bar, with an arrow at an end if values lie beyond it.
void bar_path(cairo_t* context, const Scale& scale, const Bar& bar) {
  cairo_new_path(context);
  cairo_move_to(context, bar.left, bar.top);
  cairo_line_to(context, bar.left + bar.width, bar.top);
  if (scale.above) {
    cairo_line_to(context, bar.left + bar.width + bar.height, bar.top + bar.height / 2);
  }
  cairo_line_to(context, bar.left + bar.width, bar.bottom());
  cairo_line_to(context, bar.left, bar.bottom());
  if (scale.below) {
    cairo_line_to(context, bar.left - bar.height, bar.top + bar.height / 2);
  }
  cairo_close_path(context);
}

void fill_bar(cairo_t* context, const Scale& scale, const Bar& bar) {
  cairo_pattern_t* pattern = cairo_pattern_create_linear(bar.left, 0, bar.left + bar.width, 0);
  for (int i = 0; i <= 10; ++i) {
    const Rgb c = viridis(i / 10.0);
    cairo_pattern_add_color_stop_rgb(pattern, i / 10.0, c.r, c.g, c.b);
  }
  bar_path(context, scale, bar);
  cairo_set_source(context, pattern);
  cairo_fill_preserve(context);
  cairo_pattern_destroy(pattern);
  set_colour(context, map_border_colour);
  cairo_set_line_width(context, bar.height / 15);
  cairo_stroke(context);
}

void draw_ticks(cairo_t* context, const BarTicks& bar_ticks, const Bar& bar, double text) {
  const auto tick = [&](double place, double length) {
    const double x = bar.left + place * bar.width;
    cairo_move_to(context, x, bar.bottom());
    cairo_line_to(context, x, bar.bottom() + length * text);
    cairo_stroke(context);
    return x;
  };
  set_colour(context, text_colour);
  cairo_set_line_width(context, 0.06 * text);
  for (const double place : bar_ticks.ticks.unlabelled) {
    tick(place, 0.2);
  }
  for (const Tick& labelled : bar_ticks.ticks.labelled) {
    const double x = tick(labelled.place, 0.35);
    marked_text(context, x, bar.bottom() + 1.35 * text, labelled.label, 0.5);
  }
  if (bar_ticks.exponent != 0) {
    const std::string exponent =
        (bar_ticks.exponent < 0 ? "\u2212" : "") + std::to_string(std::abs(bar_ticks.exponent));
    marked_text(context, bar.left + bar.width + 1.5 * bar.height, bar.bottom(),
                "\u00d7\u200910^{" + exponent + "}");
  }
}

void colour_bar(cairo_t* context, const Scale& scale, const Bar& bar, double text) {
  const int most = std::clamp(static_cast<int>(bar.width / (3.6 * text)), 2, 8);
  fill_bar(context, scale, bar);
  select_font(context, 0.92 * text);
  draw_ticks(context, bar_ticks(scale, most), bar, text);
}

/// A swatch, a name and a count for each class, in one line that is shrunk to fit.
void class_legend(cairo_t* context, const std::vector<ValenceClass>& classes, double page_width,
                  double top, double page_text) {
  const double gap = 1.3;    // between classes; these in letter sizes
  const double indent = 1.4; // of the label from its swatch's left
  std::vector<std::string> labels;
  double length = -gap;
  select_font(context, 0.92 * page_text);
  for (const ValenceClass& c : classes) {
    labels.push_back(c.label + ": " + grouped(c.count));
    length += indent + text_width(context, labels.back()) / page_text + gap;
  }
  const double text = page_text * std::min(1.0, 0.96 * page_width / (length * page_text));
  select_font(context, 0.92 * text);
  const double baseline = top + 1.2 * page_text;
  double x = (page_width - length * text) / 2;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    cairo_rectangle(context, x, baseline - 0.85 * text, 0.95 * text, 0.95 * text);
    set_colour(context, classes[i].colour);
    cairo_fill_preserve(context);
    set_colour(context, map_border_colour);
    cairo_set_line_width(context, 0.06 * text);
    cairo_stroke(context);
    set_colour(context, text_colour);
    cairo_move_to(context, x + indent * text, baseline);
    cairo_show_text(context, labels[i].c_str());
    x += indent * text + text_width(context, labels[i]) + gap * text;
  }
}

} // namespace

BarTicks bar_ticks(const Scale& scale, int most) {
  const double unit = is_angle(scale) ? std::numbers::pi / 180 : 1;
  Axis axis = {scale.low / unit, scale.high / unit, scale.logarithmic};
  BarTicks bar;
  bar.exponent = common_exponent(axis);
  const double power = std::pow(10, bar.exponent);
  axis.low /= power;
  axis.high /= power;
  bar.ticks = ticks_of(axis, most);
  for (Tick& tick : bar.ticks.labelled) {
    tick.label += is_angle(scale) ? "\u00b0" : "";
  }
  return bar;
}

void draw_legend(cairo_t* context, const Legend& legend, double page_width, double top,
                 double text) {
  if (legend.scale.colouring == Colouring::valence) {
    class_legend(context, legend.classes, page_width, top, text);
  } else {
    const Bar bar = {0.19 * page_width, top, 0.62 * page_width, 0.9 * text};
    colour_bar(context, legend.scale, bar, text);
  }
  set_colour(context, text_colour);
  fitted_text(context, page_width / 2, top + 3.5 * text, legend.caption, 0.92 * text,
              0.97 * page_width);
}

} // namespace calotte::tools
