// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/units_option.h"

#include "text/text.h"

#include <CLI/App.hpp>

namespace calotte::tools {

void add_units(CLI::App& command, std::optional<std::string>& word) {
  command
      .add_option("--units", word,
                  "Unit of distances on the sphere: km (default if the radius is known, as from "
                  "widths in km or --for), degrees (default otherwise) or radians. Areas are in "
                  "km^2 or steradians")
      ->check(CLI::IsMember({"km", "degrees", "radians"}));
}

Unit unit_of(const std::optional<std::string>& word, std::optional<double> radius_km) {
  if (word == "km" && !radius_km)
    refuse("--units km requires the radius of the sphere; give --sphere-radius earth, or a "
           "radius in metres");
  return calotte::unit_of(word, radius_km);
}

} // namespace calotte::tools
