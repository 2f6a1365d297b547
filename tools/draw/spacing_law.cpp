// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/spacing_law.h"

#include "draw/picture.h"
#include "draw/text.h"
#include "draw/values.h"
#include "text/text.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

namespace calotte::tools {

namespace {

constexpr Rgb dot_colour = {0.00, 0.45, 0.70};
constexpr Rgb line_of_law = {0.10, 0.11, 0.13};
constexpr Rgb median_colour = {0.84, 0.37, 0.00};
constexpr Rgb band_colour = {0.86, 0.87, 0.89};
constexpr double row = 1.6;          ///< height of a line of the legend, in letters
constexpr std::size_t least_bin = 8; ///< number of cells whose median is meaningful

/// The quantile of the values for that fraction.
double quantile(std::vector<double> values, double part) {
  const auto k = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

double extreme_ratio(const std::vector<double>& values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return *greatest / *least;
}

/// The median of the values of the cells whose spacing by the law is within a range.
double median_within(const SpacingLaw& law, const std::vector<double>& values, double low,
                     double high) {
  std::vector<double> within;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (law.lawful[i] >= low && law.lawful[i] <= high) {
      within.push_back(values[i]);
    }
  }
  return quantile(std::move(within), 0.5);
}

double end_to_end_ratio(const SpacingLaw& law, const std::vector<double>& values) {
  const double fine = quantile(law.lawful, 0.01);
  const double coarse = quantile(law.lawful, 0.99);
  return median_within(law, values, coarse, std::numeric_limits<double>::infinity()) /
         median_within(law, values, 0, fine);
}

double percent_off(const SpacingLaw& law, std::size_t cell) {
  return 100 * (law.measured[cell] / law.lawful[cell] - 1);
}

Points3 unit_sites(const Mesh& mesh) {
  Points3 sites = mesh.points;
  for (Eigen::Index i = 0; i < sites.cols(); ++i) {
    sites.col(i).stableNormalize();
  }
  return sites;
}

/// The spacings by the law of the cells that have a spacing, up to a common factor: rho^(-1/4).
std::vector<double> lawful_spacings(const Mesh& mesh, const Density& density,
                                    const std::vector<double>& spacings) {
  const DoubleVector rho = evaluate(density, unit_sites(mesh));
  std::vector<double> lawful;
  for (std::size_t i = 0; i < spacings.size(); ++i) {
    const double value = rho[static_cast<Eigen::Index>(i)];
    if (std::isnan(spacings[i])) {
      continue;
    }
    if (!(value > 0)) {
      refuse_at(static_cast<std::int64_t>(i),
                "the density is 0 at site {}, where the law has no spacing; give a density that is "
                "positive");
    }
    lawful.push_back(std::pow(value, -0.25));
  }
  return lawful;
}

// ---- The picture.

/// The range on both sides of 0, percent: up to the worst cell, unless that is far from nearly all
/// others.
Axis deviation_axis(const SpacingLaw& law) {
  std::vector<double> off(law.measured.size());
  for (std::size_t i = 0; i < off.size(); ++i) {
    off[i] = std::abs(percent_off(law, i));
  }
  const double most = *std::max_element(off.begin(), off.end());
  const double enough = std::max(1.5 * quantile(off, 0.995), 300 * law_band);
  const double shown = 1.05 * std::max(std::min(most, enough), 110 * law_band);
  return {-shown, shown};
}

std::vector<std::size_t> drawn_cells(const SpacingLaw& law) {
  const std::size_t cells = law.measured.size();
  const std::size_t dots = std::min(cells, most_dots);
  std::vector<std::size_t> drawn(dots);
  for (std::size_t k = 0; k < dots; ++k) {
    drawn[k] = k * cells / dots;
  }
  return drawn;
}

/// Translucent dots, so that many look darker than few. In a vector file each separate dot would
/// take about 200 bytes: every 16th dot shares one path.
void draw_dots(cairo_t* context, const Frame& frame, double text,
               const std::vector<PagePoint>& points) {
  constexpr std::size_t paths = 16;
  cairo_set_source_rgba(context, dot_colour.r, dot_colour.g, dot_colour.b,
                        points.size() > 5000 ? 0.22 : 0.4);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_width(context, (points.size() > 5000 ? 0.16 : 0.24) * text);
  for (std::size_t path = 0; path < paths; ++path) {
    for (std::size_t i = path; i < points.size(); i += paths) {
      const PagePoint& p = points[i];
      if (p.y >= frame.top && p.y <= frame.bottom()) {
        cairo_move_to(context, p.x, p.y);
        cairo_line_to(context, p.x, p.y);
      }
    }
    cairo_stroke(context);
  }
}

/// The cells within law_band of the law.
void draw_band(cairo_t* context, const SpacingLawPage& page) {
  const double low = page.spacing.across.low;
  const double high = page.spacing.across.high;
  set_colour(context, band_colour);
  const auto to = [&](double x, double y) {
    const PagePoint p = page.spacing.at(x, y);
    cairo_line_to(context, p.x, p.y);
  };
  to(low, (1 - law_band) * low);
  to(high, (1 - law_band) * high);
  to(high, (1 + law_band) * high);
  to(low, (1 + law_band) * low);
  cairo_fill(context);
}

void law_line(cairo_t* context, double text) {
  set_colour(context, line_of_law);
  cairo_set_line_width(context, 0.08 * text);
}

void median_line(cairo_t* context, double text) {
  set_colour(context, median_colour);
  cairo_set_line_width(context, 0.14 * text);
}

void draw_spacings(cairo_t* context, const SpacingLawPage& page, const SpacingLaw& law) {
  std::vector<PagePoint> points;
  for (const std::size_t cell : drawn_cells(law)) {
    points.push_back(page.spacing.at(law.lawful[cell], law.measured[cell]));
  }
  inside(context, page.spacing, [&] {
    draw_band(context, page);
    draw_dots(context, page.spacing, page.text, points);
    law_line(context, page.text);
    const std::vector<double> ends = {page.spacing.across.low, page.spacing.across.high};
    draw_curve(context, page.spacing, ends, ends);
  });
}

/// The median deviation of the cells in each of several equal parts of the axis.
void draw_running_median(cairo_t* context, const SpacingLawPage& page, const SpacingLaw& law) {
  std::vector<std::vector<double>> bins(30);
  for (std::size_t i = 0; i < law.measured.size(); ++i) {
    const double position = page.deviation.across.position(law.lawful[i]);
    const auto bin = static_cast<std::size_t>(position * static_cast<double>(bins.size()));
    bins[std::min(bin, bins.size() - 1)].push_back(percent_off(law, i));
  }
  std::vector<double> x;
  std::vector<double> y;
  const Axis& across = page.deviation.across;
  for (std::size_t bin = 0; bin < bins.size(); ++bin) {
    const double position = (static_cast<double>(bin) + 0.5) / static_cast<double>(bins.size());
    if (bins[bin].size() >= least_bin) {
      x.push_back(across.low * std::pow(across.high / across.low, position));
      y.push_back(quantile(std::move(bins[bin]), 0.5));
    }
  }
  median_line(context, page.text);
  draw_curve(context, page.deviation, x, y);
}

void draw_deviations(cairo_t* context, const SpacingLawPage& page, const SpacingLaw& law) {
  std::vector<PagePoint> points;
  for (const std::size_t cell : drawn_cells(law)) {
    points.push_back(page.deviation.at(law.lawful[cell], percent_off(law, cell)));
  }
  const Frame& frame = page.deviation;
  inside(context, frame, [&] {
    const double top = frame.at(1, 100 * law_band).y;
    cairo_rectangle(context, frame.left, top, frame.width, frame.at(1, -100 * law_band).y - top);
    set_colour(context, band_colour);
    cairo_fill(context);
    draw_dots(context, frame, page.text, points);
    law_line(context, page.text);
    draw_curve(context, frame, {frame.across.low, frame.across.high}, {0, 0});
    draw_running_median(context, page, law);
  });
}

std::string title_of(const SpacingLaw& law) {
  return grouped(static_cast<std::int64_t>(law.measured.size())) +
         formatted(" cells: spacing ratio %.3g", law.measured_ratio) +
         formatted(", by the law %.3g", law.lawful_ratio) +
         formatted(" (extremes %.3g); ", law.extreme_ratio) +
         formatted("%.3g\u2009%% within ", 100 * law.share) +
         formatted("\u00b1%.3g\u2009%%", 100 * law_band);
}

/// In the corner that a rising law leaves empty.
void legend(cairo_t* context, const SpacingLawPage& page, const SpacingLaw& law) {
  const double left = page.spacing.left + 1.5 * page.text;
  const double right = left + 2.2 * page.text;
  double baseline = page.spacing.top + 2 * page.text;
  const auto entry = [&](const std::string& text) {
    set_colour(context, text_colour);
    marked_text(context, right + 0.6 * page.text, baseline, text);
    baseline += row * page.text;
  };
  const auto sample = [&] {
    cairo_move_to(context, left, baseline - 0.35 * page.text);
    cairo_line_to(context, right, baseline - 0.35 * page.text);
    cairo_stroke(context);
  };
  select_font(context, page.text);
  const std::size_t dots = drawn_cells(law).size();
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  set_colour(context, dot_colour);
  cairo_set_line_width(context, 0.4 * page.text);
  cairo_move_to(context, (left + right) / 2, baseline - 0.35 * page.text);
  cairo_close_path(context);
  cairo_stroke(context);
  entry(dots == law.measured.size()
            ? "a cell"
            : "a cell (" + grouped(static_cast<std::int64_t>(dots)) + " drawn)");
  cairo_set_line_cap(context, CAIRO_LINE_CAP_BUTT);
  set_colour(context, band_colour);
  cairo_rectangle(context, left, baseline - 0.8 * page.text, right - left, 0.9 * page.text);
  cairo_fill(context);
  law_line(context, page.text);
  sample();
  entry("*h* \u221d *\u03c1*^{\u22121/4}" + formatted(", \u00b1%.3g\u2009%%", 100 * law_band));
  median_line(context, page.text);
  sample();
  entry("running median");
}

void compose(cairo_t* context, const SpacingLawPage& page, const SpacingLaw& law) {
  const AxesLook spacing = {.text = page.text,
                            .up = "mean distance to the neighbours, *h* / *h*_{0}",
                            .most_across = 9,
                            .most_up = 12,
                            .across_labels = false,
                            .up_labels = 2.2};
  const AxesLook deviation = {.text = page.text,
                              .across = "(*\u03c1*_{max} / *\u03c1*)^{1/4}",
                              .up = "off the law, %",
                              .most_across = 9,
                              .most_up = 5,
                              .up_labels = 2.2};
  select_font(context, 1.1 * page.text);
  set_colour(context, text_colour);
  const std::string title = title_of(law);
  select_font(context,
              1.1 * page.text * std::min(1.0, 0.97 * page.width / text_width(context, title)));
  centred_text(context, page.spacing.left + page.spacing.width / 2, 1.8 * page.text, title);
  draw_grid(context, page.spacing, spacing);
  draw_grid(context, page.deviation, deviation);
  draw_spacings(context, page, law);
  draw_deviations(context, page, law);
  legend(context, page, law);
  draw_axes(context, page.spacing, spacing);
  draw_axes(context, page.deviation, deviation);
}

} // namespace

SpacingLaw spacing_law(const Mesh& mesh, const Density& density) {
  const std::vector<double> spacings =
      values_of(make_scene(mesh, Shapes::cells, {}), Colouring::spacing);
  SpacingLaw law;
  law.lawful = lawful_spacings(mesh, density, spacings);
  std::copy_if(spacings.begin(), spacings.end(), std::back_inserter(law.measured),
               [](double h) { return !std::isnan(h); });
  if (law.measured.empty()) {
    refuse("no cell of this mesh is bounded; draw the law of a mesh "
           "that covers more of the sphere");
  }
  std::vector<double> factors(law.measured.size());
  std::transform(law.measured.begin(), law.measured.end(), law.lawful.begin(), factors.begin(),
                 std::divides<>());
  const double factor = quantile(std::move(factors), 0.5);
  const double finest = *std::min_element(law.lawful.begin(), law.lawful.end());
  std::size_t within = 0;
  for (std::size_t i = 0; i < law.measured.size(); ++i) {
    law.measured[i] /= factor * finest;
    law.lawful[i] /= finest;
    within += std::abs(percent_off(law, i)) <= 100 * law_band ? 1 : 0;
  }
  law.lawful_ratio = end_to_end_ratio(law, law.lawful);
  law.measured_ratio = end_to_end_ratio(law, law.measured);
  law.extreme_ratio = extreme_ratio(law.measured);
  law.share = static_cast<double>(within) / static_cast<double>(law.measured.size());
  return law;
}

SpacingLawPage spacing_law_page(const SpacingLaw& law, int size) {
  SpacingLawPage page;
  page.width = size;
  page.text = size / 60.0;
  const auto frame = [&](double top, double height, const Axis& up) {
    return Frame{5.2 * page.text,
                 top * page.text,
                 52.8 * page.text,
                 height * page.text,
                 axis_around(law.lawful, true),
                 up};
  };
  std::vector<double> spacings = law.measured; // and the whole of the law's line
  spacings.insert(spacings.end(), law.lawful.begin(), law.lawful.end());
  page.spacing = frame(3, 32, axis_around(spacings, true));
  page.deviation = frame(36.2, 13, deviation_axis(law));
  page.height = static_cast<int>(std::ceil(53 * page.text));
  return page;
}

void draw_spacing_law(const std::string& path, const Mesh& mesh, const Density& density, int size) {
  require_picture(path, size);
  const SpacingLaw law = spacing_law(mesh, density);
  const SpacingLawPage page = spacing_law_page(law, size);
  write_picture(path, page.width, page.height,
                [&](cairo_t* context) { compose(context, page, law); });
}

} // namespace calotte::tools
