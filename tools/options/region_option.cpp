// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/region_option.h"

#include "options/numbers.h"
#include "text/text.h"

#include <calotte/error.h>
#include <calotte/ocean.h>
#include <calotte/read.h>

#include <CLI/App.hpp>

#include <boost/crc.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A word of an option and its parts after the equals sign.
struct OptionWord {
  std::string option, text, form; ///< form: what to write instead, for messages
  std::vector<std::string> parts;
};

[[noreturn]] void refuse_word(const OptionWord& word, const std::string& problem) {
  refuse(message("{} {}: {}; give {}", word.option, word.text, problem, word.form));
}

/// A number of degrees, with or without the unit.
double degrees(const OptionWord& word, std::size_t part, double limit) {
  const std::optional<Measure> angle = measure_of(word.parts[part]);
  if (!angle || !(angle->unit.empty() || angle->unit == "deg") ||
      !(std::abs(angle->value) <= limit))
    refuse_word(
        word, message("\"{}\" is no angle from {} to {} degrees", word.parts[part], -limit, limit));
  return angle->value;
}

/// A length on the sphere as an angle: its unit is km, m or deg.
double length(const OptionWord& word, std::size_t part, double radius_km) {
  const std::optional<Measure> size = measure_of(word.parts[part]);
  const std::string unit = size ? size->unit : "";
  const double angle = unit == "km"    ? size->value / radius_km
                       : unit == "m"   ? size->value / 1000 / radius_km
                       : unit == "deg" ? size->value * degree
                                       : 0;
  if (!(angle > 0))
    refuse_word(word,
                message("\"{}\" is no positive length such as 1000km or 30deg", word.parts[part]));
  return angle;
}

/// The direction whose longitude and latitude are two parts.
Eigen::Vector3d direction(const OptionWord& word, std::size_t part = 0) {
  return direction_at(degrees(word, part, 720), degrees(word, part + 1, 90));
}

Surface made_of(const OptionWord& word, std::string_view shape, double radius_km) {
  if (shape == "circle")
    return circle(direction(word), length(word, 2, radius_km));
  if (shape == "ellipse")
    return ellipse(direction(word), length(word, 2, radius_km), length(word, 3, radius_km),
                   degrees(word, 4, 360) * degree);
  if (shape == "land")
    return land_around(read_coast(word.parts[0]), direction(word, 1));
  return channel(degrees(word, 0, 90) * degree, degrees(word, 1, 90) * degree);
}

constexpr std::string_view land = "land=";

/// The parts of a word: of a file of land, all but the last two are its name.
std::vector<std::string> parts_of(const std::string& word) {
  std::vector<std::string> parts = split(std::string_view(word).substr(word.find('=') + 1), ',');
  for (; word.starts_with(land) && parts.size() > 3; parts.erase(parts.begin() + 1))
    parts[0] += "," + parts[1];
  return parts;
}

/// \throws Error unless a word has so many parts.
void require_parts(const OptionWord& word, std::size_t count) {
  if (word.parts.size() != count)
    refuse_word(word,
                message("the number of values is {} instead of {}", word.parts.size(), count));
}

/// Whether a word is name=values, and no file.
bool is_unknown_shape(const std::string& word) {
  const std::size_t equals = word.find('=');
  return equals != std::string::npos && equals > 0 &&
         std::all_of(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(equals),
                     [](unsigned char c) { return std::isalpha(c) != 0; }) &&
         !std::filesystem::exists(word);
}

Surface shape_or_file(const std::string& word, double radius_km) {
  static const std::vector<std::pair<std::string, std::string>> shapes{
      {"circle", "circle=LON,LAT,RADIUS, as in circle=-105,40,1000km"},
      {"ellipse", "ellipse=LON,LAT,MAJOR,MINOR,BEARING, as in ellipse=138,38,1580km,1000km,45"},
      {"channel", "channel=LOWER,UPPER, as in channel=-23.5,23.5"},
      {"land", "land=FILE,LON,LAT, as in land=binned_GSHHS_l.nc,134,-25"}};
  for (const auto& [shape, form] : shapes)
    if (word.starts_with(shape + "=")) {
      const OptionWord parsed{"--region", word, form, parts_of(word)};
      require_parts(parsed, split(form.substr(0, form.find(", as")), ',').size());
      return made_of(parsed, shape, radius_km);
    }
  if (is_unknown_shape(word)) {
    std::vector<std::string> names;
    for (const auto& [shape, form] : shapes)
      names.push_back(shape + "=");
    refuse(
        message("--region {}: there is no such shape, and no such file; give {} or the file of a "
                "region, see calotte help region",
                word, listed(names)));
  }
  return read_region(word);
}

} // namespace

void add_inside(CLI::App& command, std::string& inside) {
  command
      .add_option("--inside", inside,
                  "A place inside the region, in degrees. Rings of a file may then run either way "
                  "and bound a region of any size. Default: they enclose the side without poles, "
                  "or else the smaller side")
      ->type_name("LON,LAT")
      ->needs(command.get_option("--region"));
}

void add_region(CLI::App& command, RegionWords& words) {
  command
      .add_option("--region", words.region,
                  "Part of the sphere to tessellate: a shape such as circle=-105,40,1000km, or a "
                  "file; see calotte help region")
      ->type_name("SHAPE|FILE");
  add_inside(command, words.inside);
  command.add_flag("--limited-area", words.limited_area,
                   "Write a grid for a regional model: the cells of the region and 7 rings of "
                   "boundary cells around it, with their masks, as an MPAS file. Requires --region "
                   "and --cell-width");
  command
      .add_option("--boundary", words.boundary,
                  "Boundary of the region: clip (it clips cells; the mesh ends within about a cell "
                  "of it), or generators (some generators stay on it, at the distances that the "
                  "density demands, and the mesh ends at them)")
      ->check(CLI::IsMember({"clip", "generators"}))
      ->capture_default_str();
}

void require_region_words(const RegionWords& words) {
  if (words.limited_area && words.region.empty())
    refuse("--limited-area requires a region; give --region");
  if (!ends_at_boundary(words))
    return;
  if (words.region.empty())
    refuse("--boundary generators requires a region; give --region");
  if (words.limited_area)
    refuse("--boundary generators does not apply to --limited-area, whose rings lie outside the "
           "region; leave one of them out");
}

Surface region_of(const std::string& word, const std::string& inside, double radius_km) {
  Surface region = shape_or_file(word, radius_km);
  if (inside.empty())
    return region;
  const OptionWord parsed{"--inside", inside, "LON,LAT, as in -105,40", split(inside, ',')};
  require_parts(parsed, 2);
  try {
    return region_around({region.rings().begin(), region.rings().end()}, direction(parsed));
  } catch (const Error& error) {
    throw Error(error.code(), message("--inside {}: {}", inside, error.what()));
  }
}

bool has_kilometres(const std::string& word) {
  return region_file(word).empty() && word.find("km") != std::string::npos;
}

std::string region_file(const std::string& word) {
  if (word.starts_with(land))
    return parts_of(word)[0];
  return word.find('=') == std::string::npos ? word : "";
}

std::string region_configuration(const Surface& region) {
  boost::crc_32_type checksum;
  Eigen::Index corners = 0;
  for (const auto& ring : region.rings()) {
    checksum.process_bytes(ring.data(), static_cast<std::size_t>(ring.size()) * sizeof(double));
    corners += ring.cols();
  }
  return message("region of {} rings and {} corners with checksum {}\n", region.rings().size(),
                 corners, checksum.checksum());
}

} // namespace calotte::tools
