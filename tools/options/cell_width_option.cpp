// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/cell_width_option.h"

#include "options/files.h"
#include "options/numbers.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace calotte::tools {
namespace {

[[noreturn]] void refuse(const std::string& problem) {
  throw Error(ErrorCode::bad_option, problem);
}

/// Validates a number of km, for an option's check.
CLI::Validator kilometres() {
  return {[](std::string& text) -> std::string {
            double value = 0;
            const char* const end = text.data() + text.size();
            const auto [stop, problem] = std::from_chars(text.data(), end, value);
            const bool good =
                problem == std::errc() && stop == end && value > 0 && std::isfinite(value);
            return good ? "" : "\"" + text + "\" is not a positive number; give km";
          },
          "KM"};
}

bool is_geojson(const std::string& path) {
  const std::string suffix = std::filesystem::path(path).extension();
  return suffix == ".geojson" || suffix == ".json";
}

} // namespace

void add_cell_width(CLI::App& command, WidthWords& words, CLI::Option* density) {
  CLI::Option* const file =
      command
          .add_option("--cell-width", words.file,
                      "Cell widths in km, instead of a density: a NetCDF raster cellWidth(lat, "
                      "lon) (.nc), JIGSAW's spacings (.msh), or polygons (.geojson)")
          ->type_name("FILE")
          ->excludes(density);
  const auto add = [&](const std::string& name, std::optional<double>& value,
                       const std::string& help) {
    command.add_option(name, value, help)->check(kilometres())->needs(file);
  };
  add("--inside-width", words.inside,
      "Width within polygons that have no property cellWidth, in km; > 0");
  add("--outside-width", words.outside, "Width outside all polygons, in km; > 0");
  add("--transition", words.transition,
      "Distance from a polygon outwards over which the width changes, in km; > 0");
  command
      .add_option("--earth-radius", words.radius,
                  "Radius of the sphere to which the widths refer, in km; > 0")
      ->check(kilometres())
      ->needs(file)
      ->capture_default_str();
  command
      .add_option(
          "--density-raster", words.raster,
          "NetCDF raster density(lat, lon), in the plane density(y, x), instead of --density")
      ->type_name("FILE")
      ->excludes(density)
      ->excludes(file);
}

CellWidth read_widths(const WidthWords& words) {
  if (!words.raster.empty())
    return read_density_raster(words.raster);
  if (!is_geojson(words.file))
    for (const auto& [value, name] : {std::pair{words.inside, "--inside-width"},
                                      {words.outside, "--outside-width"},
                                      {words.transition, "--transition"}})
      if (value)
        refuse(words.file + " holds no polygons; leave " + name + " out");
  return read_cell_width(words.file, {.inside = words.inside.value_or(0),
                                      .outside = words.outside.value_or(0),
                                      .transition = words.transition.value_or(0),
                                      .radius_km = words.radius});
}

std::string width_configuration(const WidthWords& words) {
  if (!words.raster.empty())
    return "density-raster of " + checksum_of(words.raster) + "\n";
  std::string text = "cell-width of " + checksum_of(words.file) + "\n";
  const auto add = [&](const std::string& name, const std::optional<double>& value) {
    if (value)
      text += name + " " + shortest(*value) + "\n";
  };
  add("inside-width", words.inside);
  add("outside-width", words.outside);
  add("transition", words.transition);
  add("earth-radius", words.radius);
  return text;
}

/// A number with two digits, or as many as tell it from another one.
std::string distinct_from(double other, double value) {
  std::string text;
  for (int digits = 2; digits <= 17; ++digits) {
    text = formatted(("%." + std::to_string(digits) + "g").c_str(), value);
    if (std::stod(text) != other)
      break;
  }
  return text;
}

std::string place_of(const Gradient& gradient) {
  return formatted("%.1f", std::abs(gradient.longitude)) +
         (gradient.longitude < 0 ? " W " : " E ") + formatted("%.1f", std::abs(gradient.latitude)) +
         (gradient.latitude < 0 ? " S" : " N");
}

std::vector<std::string> notes_on(const CellWidth& widths, const WidthWords& words,
                                  std::optional<std::int64_t> cells) {
  const double implied = implied_cells(widths, words.radius);
  std::vector<std::string> notes{
      words.file + ": cells " + formatted("%.4g", widths.widths.minCoeff()) + " to " +
      formatted("%.4g", widths.widths.maxCoeff()) + " km wide, on " +
      std::to_string(widths.longitudes.size()) + " x " + std::to_string(widths.latitudes.size()) +
      " nodes, require " + formatted("%.0f", implied) + " cells"};
  const double scale = cells ? std::sqrt(implied / static_cast<double>(*cells)) : 1;
  if (std::abs(scale - 1) > 0.01)
    notes.front() += "; with " + std::to_string(*cells) + " cells, widths are " +
                     formatted("%.3g", scale) + " times as large";
  const Gradient gradient = largest_gradient(widths, words.radius);
  const std::string limit = shortest(steepest_width),
                    slope = distinct_from(steepest_width, gradient.slope);
  notes.front() += "; largest gradient " + slope + " km per km";
  if (gradient.slope > steepest_width)
    notes.push_back("warning: the cell width changes by " + slope + " km per km at " +
                    place_of(gradient) + ", above " + limit + ", the limit for most models; " +
                    (words.transition ? "increase --transition" : "make the widths smoother"));
  return notes;
}

std::int64_t cells_for(const CellWidth& widths, const WidthWords& words, bool bisected) {
  constexpr double fewest = 12, most = 1 << 30;
  constexpr std::int64_t coarsest = 642; // see continuation()
  const double implied = std::round(implied_cells(widths, words.radius));
  if (!(implied >= fewest && implied <= most))
    refuse("--cells auto: " + words.file + " requires " + formatted("%.4g", implied) +
           " cells, but a grid has 12 to 1073741824; give widths in km");
  const auto cells = static_cast<std::int64_t>(implied);
  std::int64_t parts = 1; // of a coarse grid's cell
  while (bisected && (cells - 2) / (4 * parts) >= coarsest - 2)
    parts *= 4;
  return (cells - 2 + parts / 2) / parts * parts + 2;
}

} // namespace calotte::tools
