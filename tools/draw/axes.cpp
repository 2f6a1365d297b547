// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/axes.h"

#include "draw/text.h"
#include "text/text.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace calotte::tools {

namespace {

constexpr Rgb border_colour = {0.25, 0.27, 0.31};
constexpr Rgb grid_colour = {0.91, 0.92, 0.93};
constexpr double smallest = 1e-100; ///< on a logarithmic axis, and the largest's inverse
constexpr double end_tolerance =
    1e-9; ///< distance in steps within which a tick counts as an end of the axis

std::string plain_label(double value) {
  if (std::abs(value) >= 1000 && std::abs(value) < 1e15 && value == std::round(value)) {
    return (value < 0 ? "\u2212" : "") + grouped(std::llround(std::abs(value)));
  }
  return with_minus(formatted("%.6g", value));
}

/// digit times a power of ten.
std::string logarithmic_label(int digit, int exponent) {
  if (exponent >= -4 && exponent <= 3) {
    return plain_label(digit * std::pow(10, exponent));
  }
  const std::string factor = digit == 1 ? "" : std::to_string(digit) + "\u2009\u00d7\u2009";
  return factor + power_of_ten(exponent);
}

/// The smallest of 1, 2 or 5 times a power of ten that gives at most `most` steps.
double round_step(double range, int most) {
  const double least = range / most;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1., 2., 5.}) {
    if (factor * power >= least * (1 - end_tolerance)) {
      return factor * power;
    }
  }
  return 10 * power;
}

AxisTicks linear_ticks(const Axis& axis, int most) {
  AxisTicks ticks;
  const double step = round_step(axis.high - axis.low, most);
  const double first = std::ceil(axis.low / step - end_tolerance);
  for (int k = 0; (first + k) * step <= axis.high + end_tolerance * step; ++k) {
    const double value = (first + k) * step;
    ticks.labelled.push_back({axis.position(value), plain_label(value)});
  }
  return ticks;
}

/// The powers of ten, or a regular subset of them; ticks between them have no label.
AxisTicks decade_ticks(const Axis& axis, int first, int last, int most) {
  AxisTicks ticks;
  const int stride = (last - first) / most + 1;
  for (int exponent = first - 1; exponent <= last; ++exponent) {
    if (const double position = axis.position(std::pow(10, exponent)); exponent % stride == 0) {
      ticks.labelled.push_back({position, power_of_ten(exponent)});
    } else {
      ticks.unlabelled.push_back(position);
    }
    for (int digit = 2; stride == 1 && digit < 10; ++digit) {
      ticks.unlabelled.push_back(axis.position(digit * std::pow(10, exponent)));
    }
  }
  return ticks;
}

/// Digits times powers of ten, the label of each one of `digits`.
AxisTicks digit_ticks(const Axis& axis, int first, int last, const std::vector<int>& digits) {
  AxisTicks ticks;
  for (int exponent = first; exponent <= last; ++exponent) {
    for (int digit = 1; digit < 10; ++digit) {
      const double position = axis.position(digit * std::pow(10, exponent));
      if (std::find(digits.begin(), digits.end(), digit) == digits.end()) {
        ticks.unlabelled.push_back(position);
      } else {
        ticks.labelled.push_back({position, logarithmic_label(digit, exponent)});
      }
    }
  }
  return ticks;
}

void drop_outside(AxisTicks& ticks) {
  const auto outside = [](double position) {
    return position < -end_tolerance || position > 1 + end_tolerance;
  };
  std::erase_if(ticks.labelled, [&](const Tick& tick) { return outside(tick.position); });
  std::erase_if(ticks.unlabelled, outside);
}

AxisTicks logarithmic_ticks(const Axis& axis, int most) {
  const auto first = static_cast<int>(std::ceil(std::log10(axis.low) - end_tolerance));
  const auto last = static_cast<int>(std::floor(std::log10(axis.high) + end_tolerance));
  const bool short_labels = axis.low >= 5e-4 && axis.high < 1e4; // of digits between the powers
  if (last - first >= 2 || (last > first && !short_labels)) {
    AxisTicks ticks = decade_ticks(axis, first, last, most);
    drop_outside(ticks);
    return ticks;
  }
  for (const std::vector<int>& digits :
       {std::vector{1, 2, 3, 4, 5, 6, 7, 8, 9}, {1, 2, 3, 5}, {1, 2, 5}, {1, 3}, {1}}) {
    AxisTicks ticks = digit_ticks(axis, first - 1, last, digits);
    drop_outside(ticks);
    if (static_cast<int>(ticks.labelled.size()) <= most) {
      return ticks.labelled.size() < 3 && digits.size() == 9 ? linear_ticks(axis, most) : ticks;
    }
  }
  return linear_ticks(axis, most);
}

AxisTicks axis_ticks(const Axis& axis, int most) {
  return most == 0 ? AxisTicks() : ticks_of(axis, most);
}

void line(cairo_t* context, double x, double y, double to_x, double to_y) {
  cairo_move_to(context, x, y);
  cairo_line_to(context, x + to_x, y + to_y);
}

/// Ticks inwards on the lower and on the upper side.
void across_ticks(cairo_t* context, const Frame& frame, const AxesLook& look) {
  const AxisTicks ticks = axis_ticks(frame.across, look.most_across);
  const auto tick = [&](double position, double length) {
    const double x = frame.left + position * frame.width;
    line(context, x, frame.bottom(), 0, -length);
    line(context, x, frame.top, 0, length);
  };
  for (const Tick& labelled : ticks.labelled) {
    tick(labelled.position, 0.4 * look.text);
  }
  for (const double position : ticks.unlabelled) {
    tick(position, 0.2 * look.text);
  }
  cairo_stroke(context);
  for (const Tick& labelled : ticks.labelled) {
    if (look.across_labels) {
      marked_text(context, frame.left + labelled.position * frame.width,
                  frame.bottom() + 1.25 * look.text, labelled.label, 0.5);
    }
  }
}

/// The same on the left and on the right. \return the width of the labels.
double up_ticks(cairo_t* context, const Frame& frame, const AxesLook& look) {
  const AxisTicks ticks = axis_ticks(frame.up, look.most_up);
  const auto tick = [&](double position, double length) {
    const double y = frame.bottom() - position * frame.height;
    line(context, frame.left, y, length, 0);
    line(context, frame.right(), y, -length, 0);
  };
  for (const Tick& labelled : ticks.labelled) {
    tick(labelled.position, 0.4 * look.text);
  }
  for (const double position : ticks.unlabelled) {
    tick(position, 0.2 * look.text);
  }
  cairo_stroke(context);
  double width = 0;
  for (const Tick& labelled : ticks.labelled) {
    width = std::max(width, marked_width(context, labelled.label));
    marked_text(context, frame.left - 0.5 * look.text,
                frame.bottom() - labelled.position * frame.height + 0.36 * look.text,
                labelled.label, 1);
  }
  return width;
}

} // namespace

double Axis::position(double value) const {
  return logarithmic ? (std::log(value) - std::log(low)) / (std::log(high) - std::log(low))
                     : (value - low) / (high - low);
}

bool Axis::shows(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }

Axis axis_around(const std::vector<double>& values, bool logarithmic, double margin) {
  Axis axis = {logarithmic ? 0.1 : 0.0, 1, logarithmic};
  std::optional<double> least;
  double greatest = 0;
  for (const double value : values) {
    if (axis.shows(value)) {
      greatest = least ? std::max(greatest, value) : value;
      least = std::min(least.value_or(value), value);
    }
  }
  if (!least) {
    return axis;
  }
  if (logarithmic) {
    const double low = std::clamp(*least, smallest, 1 / smallest);
    const double high = std::clamp(greatest, smallest, 1 / smallest);
    const double factor = std::max(std::pow(high / low, margin), 1.1);
    return {low / factor, high * factor, true};
  }
  const double extra = std::max(margin * (greatest - *least), 0.01 * std::abs(greatest) + 1e-9);
  return {*least - extra, greatest + extra, false};
}

AxisTicks ticks_of(const Axis& axis, int most) {
  return axis.logarithmic ? logarithmic_ticks(axis, most) : linear_ticks(axis, most);
}

void draw_grid(cairo_t* context, const Frame& frame, const AxesLook& look) {
  set_colour(context, grid_colour);
  cairo_set_line_width(context, 0.05 * look.text);
  for (const Tick& tick : axis_ticks(frame.across, look.most_across).labelled) {
    line(context, frame.left + tick.position * frame.width, frame.top, 0, frame.height);
  }
  for (const Tick& tick : axis_ticks(frame.up, look.most_up).labelled) {
    line(context, frame.left, frame.bottom() - tick.position * frame.height, frame.width, 0);
  }
  cairo_stroke(context);
}

void draw_axes(cairo_t* context, const Frame& frame, const AxesLook& look) {
  set_colour(context, border_colour);
  cairo_set_line_width(context, 0.06 * look.text);
  select_font(context, look.text);
  cairo_rectangle(context, frame.left, frame.top, frame.width, frame.height);
  cairo_stroke(context);
  across_ticks(context, frame, look);
  const double labels = std::max(up_ticks(context, frame, look), look.up_labels * look.text);
  set_colour(context, text_colour);
  marked_text(context, frame.left + frame.width / 2, frame.bottom() + 2.9 * look.text, look.across,
              0.5);
  cairo_save(context);
  cairo_translate(context, frame.left - labels - 1.1 * look.text, frame.top + frame.height / 2);
  cairo_rotate(context, -std::numbers::pi / 2);
  marked_text(context, 0, 0, look.up, 0.5);
  cairo_restore(context);
}

void inside(cairo_t* context, const Frame& frame, const std::function<void()>& paint) {
  cairo_save(context);
  cairo_rectangle(context, frame.left, frame.top, frame.width, frame.height);
  cairo_clip(context);
  paint();
  cairo_restore(context);
}

void draw_curve(cairo_t* context, const Frame& frame, const std::vector<double>& x,
                const std::vector<double>& y) {
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_new_path(context);
  bool drawing = false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool shown = frame.across.shows(x[i]) && frame.up.shows(y[i]);
    if (shown) {
      const PagePoint point = frame.at(x[i], y[i]);
      if (!drawing) {
        cairo_move_to(context, point.x, point.y);
      }
      cairo_line_to(context, point.x, point.y);
    }
    drawing = shown;
  }
  cairo_stroke(context);
}

} // namespace calotte::tools
