// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_history.h"

#include "draw_picture.h"
#include "draw_text.h"

#include <calotte/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numeric>

namespace calotte::tools {

namespace {

constexpr Rgb tolerance_colour = {0.35, 0.36, 0.40};
constexpr Rgb level_colour = {0.62, 0.64, 0.67};
constexpr double least_excess = 1e-14; ///< below, energies differ by rounding
constexpr double row = 1.5;            ///< height of a line of the legend; of letters, as below
constexpr double repairs_row = 1.5;

// ---- What is drawn.

std::vector<double> iteration_numbers(const History& history) {
  std::vector<double> numbers(history.iterations.size());
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

std::vector<double> joined(const std::vector<History>& histories,
                           const std::function<std::vector<double>(const History&)>& values) {
  std::vector<double> all;
  for (const History& history : histories) {
    const std::vector<double> own = values(history);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

Axis norms_axis(const std::vector<History>& histories) {
  std::vector<double> all = joined(histories, scaled_l2);
  for (const auto& others : {joined(histories, scaled_linf), joined(histories, scaled_tolerance)}) {
    all.insert(all.end(), others.begin(), others.end());
  }
  return axis_around(all, true);
}

Axis energy_axis(const std::vector<History>& histories) {
  std::vector<double> all = joined(histories, energy_excess);
  for (double& excess : all) {
    excess = excess > 0 ? std::max(excess, least_excess) : excess;
  }
  return axis_around(all, true);
}

Axis iterations_axis(const std::vector<History>& histories) {
  std::size_t most = 1;
  for (const History& history : histories) {
    most = std::max(most, history.iterations.size());
  }
  const double margin = 0.01 * static_cast<double>(most);
  return {0.5 - margin, 0.5 + static_cast<double>(most) + margin};
}

bool has_levels(const History& history) { return level_starts(history).size() > 2; }

std::size_t count_with_levels(const std::vector<History>& histories) {
  return static_cast<std::size_t>(std::count_if(histories.begin(), histories.end(), has_levels));
}

/// Whatever a file is called, as text that can be shown.
std::string shown(const std::string& name) {
  const std::string quoted =
      nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(quoted).get<std::string>();
}

/// The runs' names: their files', with the folders where two files have the same.
std::vector<std::string> names_of(const std::vector<History>& histories) {
  std::vector<std::string> names;
  for (const History& history : histories) {
    const auto file = std::filesystem::path(history.name).filename();
    const auto same = std::count_if(histories.begin(), histories.end(), [&](const History& other) {
      return std::filesystem::path(other.name).filename() == file;
    });
    names.push_back(shown(same == 1 ? file.string() : history.name));
  }
  return names;
}

std::string counted(std::int64_t number, const std::string& thing) {
  return grouped(number) + " " + thing + (number == 1 ? "" : "s");
}

std::string summary_of(const History& history) {
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.3g s", history.seconds);
  const std::string end = history.norm == Norm::none ? ""
                          : history.converged        ? "converged in "
                                                     : "not converged in ";
  return counted(history.iterations.back().cells, "cell") + ", " + end +
         counted(static_cast<std::int64_t>(history.iterations.size()), "iteration") + ", " +
         seconds;
}

Rgb faded(const Rgb& colour) {
  const auto fade = [](double channel) { return std::lerp(channel, 1, 0.45); };
  return {fade(colour.r), fade(colour.g), fade(colour.b)};
}

// ---- The legend.

/// A sample of a line, from x to the right, in the middle of its text's letters. \return its end.
double sample(cairo_t* context, const HistoryPage& page, double x, double baseline) {
  const double y = baseline - 0.35 * page.text;
  cairo_move_to(context, x, y);
  cairo_line_to(context, x + 2.2 * page.text, y);
  cairo_stroke(context);
  return x + 2.7 * page.text;
}

void set_dashes(cairo_t* context, const HistoryPage& page, bool dashed) {
  const std::array<double, 2> dashes = {0.45 * page.text, 0.3 * page.text};
  cairo_set_line_cap(context, CAIRO_LINE_CAP_BUTT);
  cairo_set_dash(context, dashes.data(), dashed ? 2 : 0, 0);
}

void select_l2_line(cairo_t* context, const HistoryPage& page, const Rgb& colour) {
  set_colour(context, colour);
  cairo_set_line_width(context, 0.13 * page.text);
}

void select_linf_line(cairo_t* context, const HistoryPage& page, const Rgb& colour) {
  set_colour(context, faded(colour));
  cairo_set_line_width(context, 0.07 * page.text);
}

void select_tolerance_line(cairo_t* context, const HistoryPage& page) {
  set_dashes(context, page, true);
  set_colour(context, tolerance_colour);
  cairo_set_line_width(context, 0.08 * page.text);
}

void flips_mark(cairo_t* context, double x, double middle, double height) {
  cairo_move_to(context, x, middle + height / 2);
  cairo_line_to(context, x, middle - height / 2);
  cairo_stroke(context);
}

/// A triangle that stands on `bottom`.
void rebuilt_mark(cairo_t* context, double x, double bottom, double height) {
  cairo_move_to(context, x - 0.6 * height, bottom);
  cairo_line_to(context, x + 0.6 * height, bottom);
  cairo_line_to(context, x, bottom - height);
  cairo_close_path(context);
  cairo_fill(context);
}

/// One line for each run: its colour, its file, what came of it. Shrunk to the page where need be.
void runs_legend(cairo_t* context, const HistoryPage& page, const std::vector<History>& histories) {
  const std::vector<std::string> names = names_of(histories);
  for (std::size_t run = 0; run < histories.size(); ++run) {
    const double baseline = (1.7 + row * static_cast<double>(run)) * page.text;
    set_dashes(context, page, false);
    select_l2_line(context, page, history_colour(run));
    const double x = sample(context, page, page.norms.left, baseline);
    const std::string text = names[run] + ": " + summary_of(histories[run]);
    select_font(context, page.text);
    const double room = (page.norms.right() - x) / text_width(context, text);
    select_font(context, std::min(1.0, room) * page.text);
    set_colour(context, text_colour);
    cairo_move_to(context, x, baseline);
    cairo_show_text(context, text.c_str());
  }
}

bool has_tolerance(const History& history) {
  return !std::isnan(scaled_tolerance(history).front());
}

/// What the lines and marks mean, in one line beneath the runs'.
void styles_legend(cairo_t* context, const HistoryPage& page,
                   const std::vector<History>& histories) {
  const std::size_t runs = histories.size();
  const double baseline = (1.7 + row * static_cast<double>(runs)) * page.text;
  const Rgb colour = runs == 1 ? history_colour(0) : text_colour;
  double x = page.norms.left;
  const auto name = [&](const std::string& text) {
    set_colour(context, text_colour);
    x = marked_text(context, x, baseline, text) + 1.6 * page.text;
  };
  select_font(context, page.text);
  set_dashes(context, page, false);
  select_l2_line(context, page, colour);
  x = sample(context, page, x, baseline);
  name("*l*_{2} / *h*");
  select_linf_line(context, page, colour);
  x = sample(context, page, x, baseline);
  name("*l*_{\u221e} / *h*");
  if (std::any_of(histories.begin(), histories.end(), has_tolerance)) {
    select_tolerance_line(context, page);
    x = sample(context, page, x, baseline);
    set_dashes(context, page, false);
    name("tolerance");
  }
  set_colour(context, colour);
  cairo_set_line_width(context, 0.1 * page.text);
  for (const double part : {0.3, 0.6, 0.9}) {
    x += 0.3 * page.text;
    flips_mark(context, x, baseline - 0.5 * part * page.text, part * page.text);
  }
  x += 0.5 * page.text;
  name("flips");
  set_colour(context, colour);
  rebuilt_mark(context, x, baseline, 0.55 * page.text);
  x += 0.8 * page.text;
  name("rebuilt");
}

// ---- The data.

/// A curve for each level, as values of two levels are not one run's descent.
void draw_levels(cairo_t* context, const Frame& frame, const History& history,
                 const std::vector<double>& values) {
  const std::vector<double> numbers = iteration_numbers(history);
  const std::vector<std::size_t> starts = level_starts(history);
  for (std::size_t level = 0; level + 1 < starts.size(); ++level) {
    const auto part = [&](const std::vector<double>& all) {
      return std::vector(all.begin() + static_cast<std::ptrdiff_t>(starts[level]),
                         all.begin() + static_cast<std::ptrdiff_t>(starts[level + 1]));
    };
    draw_curve(context, frame, part(numbers), part(values));
  }
}

/// A line of the tolerance, with a step where it changes.
struct ToleranceLine {
  std::vector<double> x, y;
  bool operator==(const ToleranceLine&) const = default;
};

/// From end to end of the axis.
ToleranceLine tolerance_line(const Axis& across, const History& history) {
  const std::vector<double> tolerance = scaled_tolerance(history);
  ToleranceLine line = {{across.low}, {tolerance.front()}};
  for (std::size_t i = 1; i < tolerance.size(); ++i) {
    if (tolerance[i] != tolerance[i - 1] && !std::isnan(tolerance[i])) {
      line.x.insert(line.x.end(), 2, static_cast<double>(i) + 0.5);
      line.y.insert(line.y.end(), {tolerance[i - 1], tolerance[i]});
    }
  }
  line.x.push_back(across.high);
  line.y.push_back(tolerance.back());
  return line;
}

/// Each line once, as dashes on dashes would look like another.
void draw_tolerances(cairo_t* context, const HistoryPage& page,
                     const std::vector<History>& histories) {
  std::vector<ToleranceLine> drawn;
  select_tolerance_line(context, page);
  for (const History& history : histories) {
    const ToleranceLine line = tolerance_line(page.norms.across, history);
    if (std::find(drawn.begin(), drawn.end(), line) == drawn.end()) {
      draw_curve(context, page.norms, line.x, line.y);
      drawn.push_back(line);
    }
  }
  set_dashes(context, page, false);
}

void draw_norms(cairo_t* context, const HistoryPage& page, const std::vector<History>& histories) {
  inside(context, page.norms, [&] {
    for (std::size_t run = 0; run < histories.size(); ++run) {
      select_linf_line(context, page, history_colour(run));
      draw_levels(context, page.norms, histories[run], scaled_linf(histories[run]));
    }
    for (std::size_t run = 0; run < histories.size(); ++run) {
      select_l2_line(context, page, history_colour(run));
      draw_levels(context, page.norms, histories[run], scaled_l2(histories[run]));
    }
    draw_tolerances(context, page, histories);
  });
}

void draw_energy(cairo_t* context, const HistoryPage& page, const std::vector<History>& histories) {
  inside(context, page.energy, [&] {
    for (std::size_t run = 0; run < histories.size(); ++run) {
      select_l2_line(context, page, history_colour(run));
      draw_levels(context, page.energy, histories[run], energy_excess(histories[run]));
    }
  });
}

bool was_repaired(const CvtIteration& iteration) {
  return iteration.flips > 0 || iteration.rebuilt;
}

/// A run's row: strokes for flips, longer for more (by the logarithm), above triangles.
void draw_repairs(cairo_t* context, const HistoryPage& page, const History& history,
                  std::size_t run) {
  const double top = page.repairs.top + repairs_row * page.text * static_cast<double>(run);
  std::int64_t most = 1;
  for (const CvtIteration& iteration : history.iterations) {
    most = std::max(most, iteration.flips);
  }
  set_colour(context, history_colour(run));
  if (std::none_of(history.iterations.begin(), history.iterations.end(), was_repaired)) {
    select_font(context, 0.85 * page.text);
    cairo_move_to(context, page.repairs.at(1, 0).x, top + 1.1 * page.text);
    cairo_show_text(context, "no flips, not rebuilt");
  }
  cairo_set_line_cap(context, CAIRO_LINE_CAP_BUTT);
  cairo_set_line_width(context, 0.07 * page.text);
  for (std::size_t i = 0; i < history.iterations.size(); ++i) {
    const CvtIteration& iteration = history.iterations[i];
    const double x = page.repairs.at(static_cast<double>(i + 1), 0).x;
    if (iteration.flips > 0) {
      const double part =
          std::log1p(static_cast<double>(iteration.flips)) / std::log1p(static_cast<double>(most));
      const double height = (0.2 + 0.55 * part) * page.text;
      flips_mark(context, x, top + 0.95 * page.text - height / 2, height);
    }
    if (iteration.rebuilt) {
      rebuilt_mark(context, x, top + 1.42 * page.text, 0.4 * page.text);
    }
  }
}

/// Lines where a level ends, and above them the cells of each level that has room for their number.
void draw_level_ends(cairo_t* context, const HistoryPage& page, const History& history,
                     const Rgb& colour, double baseline) {
  const std::vector<std::size_t> starts = level_starts(history);
  double free_to = page.norms.right();
  for (std::size_t level = starts.size() - 1; level-- > 0;) {
    const double x =
        level == 0 ? page.norms.left
                   : page.norms.at(static_cast<double>(starts[level]) + 0.5, 1).x; // amid a step
    set_colour(context, colour);
    cairo_set_line_width(context, 0.07 * page.text);
    for (const Frame* frame : {&page.norms, &page.energy, &page.repairs}) {
      cairo_move_to(context, x, frame->top);
      cairo_line_to(context, x, level == 0 ? frame->top : frame->bottom());
    }
    cairo_stroke(context);
    const std::string label =
        grouped(history.iterations[starts[level]].cells) + (level == 0 ? " cells" : "");
    const double width = text_width(context, label);
    if (x + width <= free_to) {
      cairo_move_to(context, x, baseline);
      set_colour(context, colour.r == level_colour.r ? text_colour : colour);
      cairo_show_text(context, label.c_str());
      free_to = x - 0.6 * page.text;
    }
  }
}

void draw_all_level_ends(cairo_t* context, const HistoryPage& page,
                         const std::vector<History>& histories) {
  double baseline = page.levels;
  select_font(context, 0.85 * page.text);
  for (std::size_t run = 0; run < histories.size(); ++run) {
    if (has_levels(histories[run])) {
      draw_level_ends(context, page, histories[run],
                      histories.size() == 1 ? level_colour : history_colour(run), baseline);
      baseline += 1.1 * page.text;
    }
  }
}

void compose(cairo_t* context, const HistoryPage& page, const std::vector<History>& histories) {
  runs_legend(context, page, histories);
  styles_legend(context, page, histories);
  const AxesLook norms = {
      .text = page.text, .up = "move of the generators / *h*", .across_labels = false};
  const AxesLook energy = {.text = page.text,
                           .up = "energy, *E* / *E*_{end} \u2212 1",
                           .most_up = 6,
                           .across_labels = false};
  const AxesLook repairs = {.text = page.text, .across = "iteration", .most_up = 0};
  draw_grid(context, page.norms, norms);
  draw_grid(context, page.energy, energy);
  draw_all_level_ends(context, page, histories);
  draw_norms(context, page, histories);
  draw_energy(context, page, histories);
  inside(context, page.repairs, [&] {
    for (std::size_t run = 0; run < histories.size(); ++run) {
      draw_repairs(context, page, histories[run], run);
    }
  });
  draw_axes(context, page.norms, norms);
  draw_axes(context, page.energy, energy);
  draw_axes(context, page.repairs, repairs);
}

} // namespace

HistoryPage history_page(const std::vector<History>& histories, int size) {
  HistoryPage page;
  page.width = size;
  page.text = size / 60.0;
  const Axis across = iterations_axis(histories);
  const auto runs = static_cast<double>(histories.size());
  const auto rows = static_cast<double>(count_with_levels(histories));
  double y = 1.7 + row * (runs + 1);
  const auto frame = [&](double height, double gap, const Axis& up) {
    const Frame placed = {7 * page.text,      y * page.text, 51.2 * page.text,
                          height * page.text, across,        up};
    y += height + gap;
    return placed;
  };
  page.levels = y * page.text;
  y += rows > 0 ? 1.1 * rows - 0.65 : -0.5;
  page.norms = frame(19, 1.1, norms_axis(histories));
  page.energy = frame(14, 1.1, energy_axis(histories));
  page.repairs = frame(repairs_row * runs + 0.1, 3.6, {0, runs});
  page.height = static_cast<int>(std::ceil(y * page.text));
  return page;
}

Rgb history_colour(std::size_t run) {
  // Okabe and Ito, Color universal design, 2008, without yellow; then a brown.
  static constexpr std::array<Rgb, most_histories> colours = {{{0.00, 0.45, 0.70},
                                                               {0.84, 0.37, 0.00},
                                                               {0.00, 0.62, 0.45},
                                                               {0.80, 0.47, 0.65},
                                                               {0.00, 0.00, 0.00},
                                                               {0.34, 0.71, 0.91},
                                                               {0.90, 0.62, 0.00},
                                                               {0.48, 0.29, 0.13}}};
  return colours[run % most_histories];
}

void draw_history(const std::string& path, const std::vector<History>& histories, int size) {
  require_picture(path, size);
  if (histories.empty() || histories.size() > most_histories) {
    throw Error(ErrorCode::bad_option, "a picture shows 1 to " + std::to_string(most_histories) +
                                           " reports, not " + std::to_string(histories.size()) +
                                           "; leave some out");
  }
  const HistoryPage page = history_page(histories, size);
  write_picture(path, page.width, page.height,
                [&](cairo_t* context) { compose(context, page, histories); });
}

} // namespace calotte::tools
