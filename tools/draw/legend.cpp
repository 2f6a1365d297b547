// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/legend.h"

#include "draw/text.h"

#include <algorithm>
#include <cmath>

namespace calotte::tools {

namespace {

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

/// A round number below the axis, in steps of a power of ten above its length, if the labels would
/// otherwise agree in their first three digits.
double offset_of(const Axis& axis) {
  const double range = axis.high - axis.low;
  if (axis.logarithmic || range > 1e-3 * std::max(std::abs(axis.low), std::abs(axis.high))) {
    return 0;
  }
  const double step = std::pow(10, std::ceil(std::log10(range)));
  return std::floor(axis.low / step) * step;
}

/// True if neighbouring labels are at least `gap` apart.
bool apart(const std::vector<Tick>& ticks, double bar_width, double gap,
           const std::function<double(const std::string&)>& width_of) {
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    const double widths = width_of(ticks[i - 1].label) + width_of(ticks[i].label);
    if ((ticks[i].position - ticks[i - 1].position) * bar_width < widths / 2 + gap) {
      return false;
    }
  }
  return true;
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
  constexpr int steps = 24; // as many as a palette has
  for (int i = 0; i <= steps; ++i) {
    const double position = 1.0 * i / steps;
    const Rgb c = palette_colour(scale.palette, scale.constant ? 0.5 : position);
    cairo_pattern_add_color_stop_rgb(pattern, position, c.r, c.g, c.b);
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
  const auto tick = [&](double position, double length) {
    const double x = bar.left + position * bar.width;
    cairo_move_to(context, x, bar.bottom());
    cairo_line_to(context, x, bar.bottom() + length * text);
    cairo_stroke(context);
    return x;
  };
  set_colour(context, text_colour);
  cairo_set_line_width(context, 0.06 * text);
  for (const double position : bar_ticks.ticks.unlabelled) {
    tick(position, 0.2);
  }
  for (const Tick& labelled : bar_ticks.ticks.labelled) {
    const double x = tick(labelled.position, 0.35);
    marked_text(context, x, bar.bottom() + 1.35 * text, labelled.label, 0.5);
  }
  if (bar_ticks.exponent != 0) {
    marked_text(context, bar.left + bar.width + 1.5 * bar.height, bar.bottom(),
                "\u00d7\u2009" + power_of_ten(bar_ticks.exponent));
  }
}

/// The offset of the labels, in the space left of the bar.
void draw_offset(cairo_t* context, const Scale& scale, double offset, const Bar& bar, double text) {
  const std::string label = number_text(offset, 15) + (scale.degrees ? "\u00b0" : "") + "\u2009+";
  const double room = bar.left - 1.8 * bar.height;
  fitted_text(context, 0.3 * bar.height + room / 2, bar.bottom(), label, 0.92 * text, room);
}

void colour_bar(cairo_t* context, const Scale& scale, const Bar& bar, double text) {
  fill_bar(context, scale, bar);
  select_font(context, 0.92 * text);
  if (scale.constant) {
    set_colour(context, text_colour);
    marked_text(context, bar.left + bar.width / 2, bar.bottom() + 1.35 * text, constant_text(scale),
                0.5);
    return;
  }
  const BarTicks ticks =
      fitted_ticks(scale, bar.width, 0.7 * text,
                   [context](const std::string& label) { return marked_width(context, label); });
  draw_ticks(context, ticks, bar, text);
  if (ticks.offset != 0) {
    draw_offset(context, scale, ticks.offset, bar, text);
  }
}

/// A swatch, a name and a count for each class, in one line that is shrunk to fit.
void class_legend(cairo_t* context, const std::vector<ValueClass>& classes, double page_width,
                  double top, double page_text) {
  const double gap = 1.3;    // between classes; these in letter sizes
  const double indent = 1.4; // of the label from its swatch's left
  std::vector<std::string> labels;
  double length = -gap;
  select_font(context, 0.92 * page_text);
  for (const ValueClass& c : classes) {
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
  Axis axis = {scale.low, scale.high, scale.logarithmic};
  BarTicks bar;
  bar.offset = offset_of(axis);
  axis.low -= bar.offset;
  axis.high -= bar.offset;
  bar.exponent = common_exponent(axis);
  const double power = std::pow(10, bar.exponent);
  axis.low /= power;
  axis.high /= power;
  bar.ticks = ticks_of(axis, most);
  for (Tick& tick : bar.ticks.labelled) {
    tick.label += scale.degrees ? "\u00b0" : "";
  }
  return bar;
}

BarTicks fitted_ticks(const Scale& scale, double bar_width, double gap,
                      const std::function<double(const std::string&)>& width_of) {
  constexpr int most_labels = 8;
  for (int most = most_labels; most >= 2; --most) {
    BarTicks bar = bar_ticks(scale, most);
    if (bar.ticks.labelled.size() <= most_labels &&
        apart(bar.ticks.labelled, bar_width, gap, width_of)) {
      return bar;
    }
  }
  BarTicks bar = bar_ticks(scale, 2);
  std::vector<Tick>& labelled = bar.ticks.labelled;
  for (std::size_t i = 1; i < labelled.size();) {
    if (apart({labelled[i - 1], labelled[i]}, bar_width, gap, width_of)) {
      ++i;
    } else {
      bar.ticks.unlabelled.push_back(labelled[i].position);
      labelled.erase(labelled.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return bar;
}

std::string constant_text(const Scale& scale) {
  const std::string degrees = scale.degrees ? "\u00b0" : "";
  const double middle = scale.least + (scale.greatest - scale.least) / 2;
  if (scale.least == scale.greatest) {
    return "constant " + number_text(middle, 6) + degrees;
  }
  return number_text(middle, 6) + degrees + " \u00b1 " +
         number_text((scale.greatest - scale.least) / 2, 1) + degrees;
}

void draw_legend(cairo_t* context, const Legend& legend, double page_width, double top,
                 double text) {
  if (has_classes(legend.scale.colouring)) {
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
