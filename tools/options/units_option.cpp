// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/units_option.h"

#include "text/text.h"

#include <CLI/App.hpp>

#include <numbers>

namespace calotte::tools {

void add_units(CLI::App& command, std::optional<std::string>& word) {
  command
      .add_option("--units", word,
                  "Unit of distances on the sphere: km (default if the radius is known), degrees "
                  "(default otherwise) or radians. Areas are in km^2 or steradians")
      ->check(CLI::IsMember({"km", "degrees", "radians"}));
}

Unit unit_of(const std::optional<std::string>& word, std::optional<double> radius_km) {
  const std::string name = word.value_or(radius_km ? "km" : "degrees");
  if (name == "km" && !radius_km)
    refuse("--units km requires the radius of the sphere; give --sphere-radius earth, or a "
           "radius in metres");
  if (name == "km")
    return {name, *radius_km, "km^2", *radius_km * *radius_km};
  return {name, name == "degrees" ? 180 / std::numbers::pi : 1, "steradians", 1};
}

} // namespace calotte::tools
