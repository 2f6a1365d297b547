// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/cell_width_option.h"

#include "io/command.h"
#include "options/files.h"
#include "options/numbers.h"
#include "text/text.h"

#include <calotte/generators.h>
#include <calotte/read.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

namespace calotte::tools {
namespace {

/// Whether the name is that of widths without polygons. Others are refused where they are read.
bool holds_other_widths(const std::string& path) {
  const std::string suffix = std::filesystem::path(path).extension();
  return suffix == ".nc" || suffix == ".msh" || has_rules(path);
}

/// \param text of --cell-width, checked by width_or_file().
void set_widths(WidthWords& words, const std::string& text) {
  const std::optional<Measure> width = measure_of(text);
  words.uniform = width ? std::optional(kilometres_of(*width)) : std::nullopt;
  words.with_unit = width && !width->unit.empty();
  words.file = width ? "" : text;
}

/// A width in km, or any text that is none: the name of a file.
CLI::Validator width_or_file() {
  return {[width = kilometres()](std::string& text) {
            std::string number = text;
            const bool starts_as_number = text.find_first_of("0123456789") == 0;
            std::error_code error;
            return measure_of(text) ||
                           (starts_as_number && !std::filesystem::path(text).has_extension() &&
                            !std::filesystem::exists(text, error))
                       ? width(number)
                       : std::string();
          },
          ""};
}

constexpr double fewest = 12, most = 1 << 30;

/// The number of cells of a uniform grid for the number that its width requires; 0 if there is
/// none.
std::int64_t cells_of_uniform(double implied) {
  const double cells = std::round(implied);
  return cells >= fewest && cells <= most ? geodesic_count(cells) : 0;
}

/// The factor on widths that imply a number of cells, in a grid of another number, if that is
/// given.
double scale_of(double implied, std::optional<std::int64_t> cells) {
  return cells ? std::sqrt(implied / static_cast<double>(*cells)) : 1;
}

/// The cells that a uniform width requires, and the width in a grid of another number.
std::string note_on_uniform(double implied, const WidthWords& words,
                            std::optional<std::int64_t> cells, const Unit& unit) {
  const double of_km = unit.of_radian / words.radius;
  const std::string note = message(
      "cells {} wide require {} cells",
      unit.name == "km" ? name_of(words)
                        : message("{} {}", formatted("%.4g", *words.uniform * of_km), unit.name),
      formatted("%.0f", implied));
  if (!cells || *cells == std::llround(implied))
    return note;
  const std::string width =
      message("{} {} wide", formatted("%.4g", *words.uniform * of_km * scale_of(implied, cells)),
              unit.name);
  return *cells == cells_of_uniform(implied)
             ? message("{}; a symmetric grid near that has {}, {}", note, *cells, width)
             : message("{}; the {} cells of the grid are {}", note, *cells, width);
}

/// Whether the number of cells scales widths so that a note says so.
bool is_scaled(double scale) { return std::abs(scale - 1) > 0.01; }

/// "; with 100 cells, widths are 2 times as large", or "".
std::string scale_words(double scale, std::optional<std::int64_t> cells) {
  return is_scaled(scale) ? message("; with {} cells, widths are {} times as large", *cells,
                                    formatted("%.3g", scale))
                          : "";
}

std::vector<std::string> with_doubt(std::vector<std::string> notes, const WidthField& widths,
                                    const WidthWords& words) {
  if (const std::string doubt = doubt_of(widths, words); !doubt.empty())
    notes.push_back("warning: " + doubt);
  return notes;
}

PolygonWidths polygons_of(const WidthWords& words) {
  return {.inside = words.inside.value_or(0),
          .outside = words.outside.value_or(0),
          .transition = words.transition.value_or(0),
          .radius_km = words.radius};
}

/// \throws Error invalid_argument for a width with a unit.
void require_no_unit(const WidthWords& words) {
  if (words.with_unit)
    refuse("--cell-width: the plane has the unit of its coordinates; give a number without a unit");
}

/// \throws Error invalid_argument for widths of polygons without polygons.
void require_polygons(const WidthWords& words) {
  if (words.uniform || holds_other_widths(words.file))
    for (const auto& [value, name] : {std::pair{words.inside, "--inside-width"},
                                      {words.outside, "--outside-width"},
                                      {words.transition, "--transition"}})
      if (value)
        refuse(message("{} holds no polygons; leave {} out", name_of(words), name));
}

/// The widths without the command's limit of their gradient.
WidthRules read_as_given(const WidthWords& words, const Surface& surface) {
  if (!surface.is_sphere())
    require_no_unit(words);
  require_polygons(words);
  if (words.uniform)
    return {.widths = *words.uniform};
  if (has_rules(words.file))
    return read_width_rules(words.file, surface, words.radius);
  return {.widths = read_cell_width(words.file, polygons_of(words), surface)};
}

/// A number with two digits, or as many as tell it from another one.
std::string distinct_from(double other, double value) {
  std::string text;
  for (int digits = 2; digits <= 17; ++digits) {
    text = formatted(message("%.{}g", digits).c_str(), value);
    if (std::stod(text) != other)
      break;
  }
  return text;
}

/// What makes steep widths less steep.
std::string remedy_of(const WidthWords& words, bool scaled) {
  if (words.gradient)
    return message("give a smaller --gradient{}", scaled ? ", as --cells scales the widths" : "");
  return message("give --gradient {}{}", steepest_width,
                 words.transition ? ", or increase --transition" : "");
}

/// "cells 100 to 200 km wide", and the nodes.
/// \param scale unit of one of the widths.
std::string range_words(const WidthField& widths, const WidthWords& words, double scale,
                        const std::string& unit) {
  return message("{}: cells {} to {}{} wide, at {} nodes{}, require ", words.file,
                 formatted("%.4g", scale * widths.least()),
                 formatted("%.4g", scale * widths.greatest()), unit.empty() ? "" : " " + unit,
                 widths.nodes(),
                 widths.apart() > 1 ? formatted(" up to %.3g widths apart", widths.apart()) : "");
}

/// A gradient above 0, in km per km.
CLI::Validator slope() {
  return {[](std::string& text) -> std::string {
            const std::optional<Measure> value = measure_of(text);
            return value && value->unit.empty() && value->value > 0
                       ? std::string()
                       : message("\"{}\" is not a positive number; give km per km, such as 0.03",
                                 text);
          },
          "G"};
}

} // namespace

CLI::Option* add_width_file(CLI::App& command, WidthWords& words, const std::string& purpose) {
  CLI::Option* const file =
      command
          .add_option_function<std::string>(
              "--cell-width", [&words](const std::string& text) { set_widths(words, text); },
              purpose +
                  ": one width, such as 60km, or a file. Files: "
                  "NetCDF cellWidth(lat, lon) (.nc), JIGSAW's spacings (.msh), polygons "
                  "(.geojson), or rules (.toml), see calotte help widths. In the plane a number in "
                  "its unit, NetCDF cellWidth(y, x), JIGSAW's spacings, or rules")
          ->check(width_or_file())
          ->type_name("KM|FILE");
  const auto add = [&](const std::string& name, std::optional<double>& value,
                       const std::string& help) {
    command.add_option(name, value, help)->transform(kilometres())->needs(file);
  };
  add("--inside-width", words.inside,
      "Width within polygons that have no property cellWidth, in km; > 0");
  add("--outside-width", words.outside, "Width outside all polygons, in km; > 0");
  add("--transition", words.transition,
      "Distance from a polygon outwards over which the width changes, in km; > 0");
  command
      .add_option("--earth-radius", words.radius,
                  "Radius of the sphere to which the widths refer, in km; > 0")
      ->transform(kilometres())
      ->needs(file)
      ->capture_default_str();
  return file;
}

CLI::Option* add_gradient(CLI::App& command, std::optional<double>& gradient,
                          const std::string& help) {
  return command.add_option("--gradient", gradient, help)->check(slope());
}

void add_cell_width(CLI::App& command, WidthWords& words, CLI::Option* density) {
  CLI::Option* const file =
      add_width_file(command, words, "Cell widths in km, instead of a density");
  file->excludes(density);
  add_gradient(command, words.gradient,
               "Largest change of the widths, in km per km, such as 0.03: the largest widths "
               "that are nowhere above the given ones and nowhere steeper; > 0. With --cells it "
               "holds before that number scales the widths")
      ->needs(file);
  command
      .add_option("--density-raster", words.raster,
                  "NetCDF raster density(lat, lon), in the plane density(y, x), instead of "
                  "--density; or in "
                  "the plane a picture (.png), where it is dark cells are dense. Its pixels have "
                  "the side 1, "
                  "and it is the domain if none is given")
      ->type_name("FILE")
      ->excludes(density)
      ->excludes(file);
}

std::string name_of(const WidthWords& words) {
  return words.uniform ? shortest(*words.uniform) + (words.plane ? "" : " km") : words.file;
}

WidthRules read_widths(const WidthWords& words, const Surface& surface) {
  WidthRules read = read_as_given(words, surface);
  read.widths = read.widths.on_sphere(words.radius);
  if (words.gradient && !words.uniform) {
    read.widths = read.widths.limit_gradient(*words.gradient, surface);
    read.gradient = std::min(*words.gradient, read.gradient.value_or(*words.gradient));
  }
  return read;
}

std::string width_configuration(const WidthWords& words) {
  if (!words.raster.empty())
    return message("density-raster of {}\n", checksum_of(words.raster));
  std::string text =
      message("cell-width {}\n", words.uniform ? name_of(words) : "of " + checksum_of(words.file));
  if (has_rules(words.file))
    for (const std::string& named : files_of_rules(words.file))
      text += message("rules of {}\n", checksum_of(named));
  const auto add = [&](const std::string& name, const std::optional<double>& value) {
    if (value)
      text += message("{} {}\n", name, shortest(*value));
  };
  add("inside-width", words.inside);
  add("outside-width", words.outside);
  add("transition", words.transition);
  add("gradient", words.gradient);
  add("earth-radius", words.radius);
  return text;
}

WidthGradient steepest_of(const WidthField& widths, const WidthWords& words,
                          std::optional<double> limit, double scale) {
  // Widths that are larger on a sphere have the gradient of the same on a smaller one.
  WidthGradient steepest = largest_gradient(widths, words.radius / scale);
  // At the tip of a cone the interpolated field is sqrt(2) times as steep as the widths, and where
  // tiles of two densities of nodes meet there up to sqrt(5) times.
  constexpr double at_tips = 2.24;
  if (limit && steepest.slope < at_tips * *limit * scale)
    steepest.slope = std::min(steepest.slope, *limit * scale);
  return steepest;
}

std::string lonlat_words(const WidthGradient& gradient) {
  return lonlat_words(gradient.longitude, gradient.latitude);
}

std::string doubt_of(const WidthField& widths, const WidthWords& words) {
  const double most = widths.greatest();
  if (most <= widest_in_km || words.with_unit)
    return "";
  return message("{}cells {} km wide are large; if these are metres, give km",
                 words.uniform ? "" : words.file + ": ", most);
}

std::vector<std::string> notes_on(const WidthField& widths, const WidthWords& words,
                                  std::optional<double> limit, std::optional<std::int64_t> cells,
                                  const Unit& unit) {
  const double implied = implied_cells(widths, {}, words.radius);
  if (words.uniform)
    return with_doubt({note_on_uniform(implied, words, cells, unit)}, widths, words);
  const double scale = scale_of(implied, cells);
  const WidthGradient gradient = steepest_of(widths, words, limit, scale);
  const std::string slope = distinct_from(steepest_width, gradient.slope);
  std::vector<std::string> notes{
      message("{}{} cells{}; largest gradient {} km per km",
              range_words(widths, words, unit.of_radian / words.radius, unit.name),
              formatted("%.0f", implied), scale_words(scale, cells), slope)};
  if (is_too_steep(gradient.slope))
    notes.push_back(message("warning: the cell width changes by {} km per km at {}, above {}, the "
                            "limit for most models; {}",
                            slope, lonlat_words(gradient), steepest_width,
                            remedy_of(words, is_scaled(scale))));
  return with_doubt(std::move(notes), widths, words);
}

std::vector<std::string> notes_in_plane(const WidthField& widths, const WidthWords& words,
                                        double implied, std::optional<std::int64_t> cells) {
  return {message("{}{} cells{}",
                  words.uniform ? message("cells {} wide require ", *words.uniform)
                                : range_words(widths, words, 1, ""),
                  formatted("%.0f", implied), scale_words(scale_of(implied, cells), cells))};
}

} // namespace calotte::tools
