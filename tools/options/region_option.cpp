// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/region_option.h"

#include "io/command.h"
#include "options/choice.h"
#include "options/numbers.h"
#include "text/text.h"

#include <calotte/error.h>
#include <calotte/grid.h>
#include <calotte/read.h>

#include <CLI/App.hpp>

#include <boost/crc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

/// The point of --inside.
/// \throws Error invalid_argument for other text.
Eigen::Vector3d point_inside(const std::string& word) {
  const auto place = numbers_of<2>(word);
  require(place && std::abs((*place)[0]) <= 720 && std::abs((*place)[1]) <= 90,
          "--inside {}: this is no place; give LON,LAT in degrees, as in -105,40", word);
  return direction_at((*place)[0], (*place)[1]);
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

void add_boundary(CLI::App& command, Boundary& boundary, const char* help) {
  std::vector<std::pair<std::string, Boundary>> choices;
  for (const auto& [word, value] : boundary_words())
    choices.emplace_back(word, value);
  add_choice<Boundary>(command, "--boundary", boundary, choices, help);
}

void add_region(CLI::App& command, RegionWords& words) {
  command
      .add_option("--region", words.region,
                  "Part of the sphere to tessellate: a shape such as circle=-105,40,1000km or "
                  "box=-20,30,40,60, or a file; see calotte help region")
      ->type_name("SHAPE|FILE");
  add_inside(command, words.inside);
  command.add_flag("--limited-area", words.limited_area,
                   "Write a grid for a regional model: the cells of the region and 7 rings of "
                   "boundary cells around it, with their masks, as an MPAS file. Requires --region "
                   "and --cell-width");
  add_boundary(command, words.boundary,
               "Boundary of the region: clip (it clips cells; the mesh ends within about a cell of "
               "it), or generators (some generators stay on it, at the distances that the density "
               "demands, and the mesh ends at them)");
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
  const auto of_option = [](const std::string& option, const auto& make) {
    try {
      return make();
    } catch (const Error& error) {
      throw Error(error.code(), message("{} {}", option, error.what()), error.index());
    }
  };
  const Surface region = region_file(word).empty()
                             ? of_option("--region", [&] { return read_region(word, radius_km); })
                             : read_region(word, radius_km);
  if (inside.empty())
    return region;
  const Eigen::Vector3d point = point_inside(inside);
  return of_option(message("--inside {}:", inside), [&] {
    return region_around({region.rings().begin(), region.rings().end()}, point);
  });
}

bool has_length(const std::string& word) {
  return region_file(word).empty() &&
         std::ranges::any_of(split(std::string_view(word).substr(word.find('=') + 1), ','),
                             [](const std::string& value) {
                               const std::optional<Measure> measure = measure_of(value);
                               return measure && (measure->unit == "km" || measure->unit == "m");
                             });
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
