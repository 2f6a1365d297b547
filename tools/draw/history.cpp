// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/history.h"

#include "draw/picture.h"
#include "draw/text.h"
#include "text/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace calotte::tools {

namespace {

constexpr Rgb tolerance_colour = {0.35, 0.36, 0.40};
constexpr Rgb level_colour = {0.62, 0.64, 0.67};

/// The names of the runs: those of their files, with the folders if two files have the same name.
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

/// As counted(), with the digits in groups.
std::string counted_in_groups(std::int64_t number, const std::string& thing) {
  return message("{} {}{}", grouped(number), thing, number == 1 ? "" : "s");
}

/// The method of a run and its cost.
std::string summary_of(const History& history) {
  const std::string end = history.norm == Norm::none ? ""
                          : history.converged        ? "converged in "
                                                     : "not converged in ";
  const std::string method = history.method.empty() ? "" : ", " + history.method;
  return message("{}: {}, {}{}, {}", method,
                 counted_in_groups(history.iterations.back().cells, "cell"), end,
                 counted_in_groups(std::ssize(history.iterations), "evaluation"),
                 formatted("%.3g s", history.seconds));
}

Rgb faded(const Rgb& colour) {
  const auto fade = [](double channel) { return std::lerp(channel, 1, 0.45); };
  return {fade(colour.r), fade(colour.g), fade(colour.b)};
}

double left_of(const HistoryPage& page) { return page.columns.front().norms.left; }
double right_of(const HistoryPage& page) { return page.columns.back().norms.right(); }

// ---- The legend.

/// A sample of a line, from x to the right, vertically centred on its text.
/// \return its end.
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

/// One line for each run: colour, file, outcome. Shrunk to fit the page.
void runs_legend(cairo_t* context, const HistoryPage& page, const std::vector<History>& histories) {
  const std::vector<std::string> names = names_of(histories);
  for (std::size_t run = 0; run < histories.size(); ++run) {
    const double baseline = (1.7 + legend_row * static_cast<double>(run)) * page.text;
    set_dashes(context, page, false);
    select_l2_line(context, page, history_colour(run));
    const double x = sample(context, page, left_of(page), baseline);
    const std::string text = names[run] + summary_of(histories[run]);
    select_font(context, page.text);
    const double room = (right_of(page) - x) / text_width(context, text);
    select_font(context, std::min(1.0, room) * page.text);
    set_colour(context, text_colour);
    cairo_move_to(context, x, baseline);
    cairo_show_text(context, text.c_str());
  }
}

bool has_tolerance(const History& history) {
  return !std::isnan(scaled_tolerance(history).front());
}

/// Explains the lines and marks, in one line below those of the runs.
void styles_legend(cairo_t* context, const HistoryPage& page,
                   const std::vector<History>& histories) {
  const std::size_t runs = histories.size();
  const double baseline = (1.7 + legend_row * static_cast<double>(runs)) * page.text;
  const Rgb colour = runs == 1 ? history_colour(0) : text_colour;
  double x = left_of(page);
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

/// The points of a curve.
struct CurvePoints {
  std::vector<double> x, y;
  bool operator==(const CurvePoints&) const = default;
};

CurvePoints accepted_points(const History& history, const std::vector<double>& x,
                            const std::vector<double>& y, std::size_t first, std::size_t last) {
  CurvePoints points;
  for (std::size_t i = first; i < last; ++i) {
    if (history.iterations[i].accepted) {
      points.x.push_back(x[i]);
      points.y.push_back(y[i]);
    }
  }
  return points;
}

/// One curve per level, because values of two levels do not belong to one descent.
void draw_levels(cairo_t* context, const Frame& frame, const History& history, Across across,
                 const std::vector<double>& values) {
  const std::vector<double> x = positions(history, across);
  const std::vector<std::size_t> starts = level_starts(history);
  for (std::size_t level = 0; level + 1 < starts.size(); ++level) {
    const CurvePoints points =
        accepted_points(history, x, values, starts[level], starts[level + 1]);
    draw_curve(context, frame, points.x, points.y);
  }
}

/// The line of the tolerance from end to end of the axis, with a step where it changes.
CurvePoints tolerance_line(const HistoryColumn& column, const History& history) {
  const Axis& across = column.norms.across;
  const std::vector<double> tolerance = scaled_tolerance(history);
  CurvePoints line = {{across.low}, {tolerance.front()}};
  for (std::size_t i = 1; i < tolerance.size(); ++i) {
    if (tolerance[i] != tolerance[i - 1] && !std::isnan(tolerance[i])) {
      line.x.insert(line.x.end(), 2, border_before(history, i, column.quantity));
      line.y.insert(line.y.end(), {tolerance[i - 1], tolerance[i]});
    }
  }
  line.x.push_back(across.high);
  line.y.push_back(tolerance.back());
  return line;
}

/// Draws each line once: overlapping dashes would look like a different pattern.
void draw_tolerances(cairo_t* context, const HistoryPage& page, const HistoryColumn& column,
                     const std::vector<History>& histories) {
  std::vector<CurvePoints> drawn;
  select_tolerance_line(context, page);
  for (const History& history : histories) {
    const CurvePoints line = tolerance_line(column, history);
    if (std::find(drawn.begin(), drawn.end(), line) == drawn.end()) {
      draw_curve(context, column.norms, line.x, line.y);
      drawn.push_back(line);
    }
  }
  set_dashes(context, page, false);
}

void draw_norms(cairo_t* context, const HistoryPage& page, const HistoryColumn& column,
                const std::vector<History>& histories) {
  const auto draw = [&](const History& history, const std::vector<double>& values) {
    draw_levels(context, column.norms, history, column.quantity, values);
  };
  inside(context, column.norms, [&] {
    for (std::size_t run = 0; run < histories.size(); ++run) {
      select_linf_line(context, page, history_colour(run));
      draw(histories[run], scaled_linf(histories[run]));
    }
    for (std::size_t run = 0; run < histories.size(); ++run) {
      select_l2_line(context, page, history_colour(run));
      draw(histories[run], scaled_l2(histories[run]));
    }
    draw_tolerances(context, page, column, histories);
  });
}

void draw_energy(cairo_t* context, const HistoryPage& page, const HistoryColumn& column,
                 const std::vector<History>& histories) {
  const std::vector<std::vector<double>> excess = energy_excess(histories);
  inside(context, column.energy, [&] {
    for (std::size_t run = 0; run < histories.size(); ++run) {
      select_l2_line(context, page, history_colour(run));
      draw_levels(context, column.energy, histories[run], column.quantity, excess[run]);
    }
  });
}

bool was_repaired(const CvtIteration& iteration) {
  return iteration.flips > 0 || iteration.rebuilt;
}

/// The length of a stroke in letters: longer for more flips, logarithmically.
double stroke_length(std::int64_t flips, std::int64_t most) {
  return 0.2 +
         0.55 * std::log1p(static_cast<double>(flips)) / std::log1p(static_cast<double>(most));
}

std::int64_t most_flips(const History& history) {
  std::int64_t most = 1;
  for (const CvtIteration& iteration : history.iterations) {
    most = std::max(most, iteration.flips);
  }
  return most;
}

/// A run's row: strokes for flips above triangles for rebuilds.
void draw_repairs(cairo_t* context, const HistoryPage& page, const HistoryColumn& column,
                  const History& history, double top) {
  const auto& iterations = history.iterations;
  if (std::none_of(iterations.begin(), iterations.end(), was_repaired)) {
    select_font(context, 0.85 * page.text);
    cairo_move_to(context, column.repairs.left + 0.7 * page.text, top + 1.1 * page.text);
    cairo_show_text(context, "no flips, not rebuilt");
  }
  const std::int64_t most = most_flips(history);
  const std::vector<double> x = positions(history, column.quantity);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_BUTT);
  cairo_set_line_width(context, 0.07 * page.text);
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    if (!was_repaired(iterations[i]) || !column.repairs.across.shows(x[i])) {
      continue;
    }
    const double across = column.repairs.at(x[i], 0).x;
    if (iterations[i].flips > 0) {
      const double height = stroke_length(iterations[i].flips, most) * page.text;
      flips_mark(context, across, top + 0.95 * page.text - height / 2, height);
    }
    if (iterations[i].rebuilt) {
      rebuilt_mark(context, across, top + 1.42 * page.text, 0.4 * page.text);
    }
  }
}

void draw_all_repairs(cairo_t* context, const HistoryPage& page, const HistoryColumn& column,
                      const std::vector<History>& histories) {
  inside(context, column.repairs, [&] {
    double top = column.repairs.top;
    for (std::size_t run = 0; run < histories.size(); ++run) {
      set_colour(context, history_colour(run));
      draw_repairs(context, page, column, histories[run], top);
      top += repairs_row * page.text;
    }
  });
}

/// A line through a column's frames.
void draw_level_end(cairo_t* context, const HistoryPage& page, const HistoryColumn& column,
                    double x) {
  cairo_set_line_width(context, 0.07 * page.text);
  for (const Frame* frame : {&column.norms, &column.energy, &column.repairs}) {
    cairo_move_to(context, x, frame->top);
    cairo_line_to(context, x, frame->bottom());
  }
  cairo_stroke(context);
}

/// Lines at the ends of levels, with the number of cells above if there is space.
void draw_level_ends(cairo_t* context, const HistoryPage& page, const HistoryColumn& column,
                     const History& history, const Rgb& colour, double baseline) {
  const std::vector<std::size_t> starts = level_starts(history);
  const Frame& frame = column.norms;
  double free_to = frame.right();
  for (std::size_t level = starts.size() - 1; level-- > 0;) {
    double x = frame.left;
    set_colour(context, colour);
    if (level > 0) {
      const double border = border_before(history, starts[level], column.quantity);
      x = std::max(x, frame.across.shows(border) ? frame.at(border, 1).x : x);
      draw_level_end(context, page, column, x);
    }
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

void draw_all_level_ends(cairo_t* context, const HistoryPage& page, const HistoryColumn& column,
                         const std::vector<History>& histories) {
  double baseline = page.levels;
  select_font(context, 0.85 * page.text);
  for (std::size_t run = 0; run < histories.size(); ++run) {
    if (has_levels(histories[run])) {
      draw_level_ends(context, page, column, histories[run],
                      histories.size() == 1 ? level_colour : history_colour(run), baseline);
      baseline += 1.1 * page.text;
    }
  }
}

/// The columns share the vertical axes, whose names are on the left.
void draw_column(cairo_t* context, const HistoryPage& page, const HistoryColumn& column,
                 const std::vector<History>& histories) {
  const bool named = &column == &page.columns.front();
  const AxesLook norms = {
      .text = page.text, .up = named ? "move of the generators / *h*" : "", .across_labels = false};
  const AxesLook energy = {.text = page.text,
                           .up = named ? "energy, *E* / *E*_{min} \u2212 1" : "",
                           .most_up = 6,
                           .across_labels = false};
  const AxesLook repairs = {
      .text = page.text,
      .across = column.quantity == Across::seconds ? "seconds" : "evaluations of the energy",
      .most_up = 0};
  draw_grid(context, column.norms, norms);
  draw_grid(context, column.energy, energy);
  draw_all_level_ends(context, page, column, histories);
  draw_norms(context, page, column, histories);
  draw_energy(context, page, column, histories);
  draw_all_repairs(context, page, column, histories);
  draw_axes(context, column.norms, norms);
  draw_axes(context, column.energy, energy);
  draw_axes(context, column.repairs, repairs);
}

void compose(cairo_t* context, const HistoryPage& page, const std::vector<History>& histories) {
  runs_legend(context, page, histories);
  styles_legend(context, page, histories);
  for (const HistoryColumn& column : page.columns) {
    draw_column(context, page, column, histories);
  }
}

} // namespace

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
    refuse(message("a picture shows 1 to {} reports, not {}; leave some out", most_histories,
                   histories.size()));
  }
  const HistoryPage page = history_page(histories, size);
  write_picture(path, page.width, page.height,
                [&](cairo_t* context) { compose(context, page, histories); });
}

} // namespace calotte::tools
