// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "quality/room.h"

#include <calotte/quality.h>

#include <numbers>

namespace calotte {

using base_detail::require;

Unit unit_of(const std::optional<std::string>& units, std::optional<double> radius_km) {
  const std::string name = units.value_or(radius_km ? "km" : "degrees");
  require(name == "km" || name == "degrees" || name == "radians",
          "the unit \"{}\" is not one of km, degrees, radians", name);
  require(name != "km" || radius_km.has_value(),
          "km require the radius of the sphere; give it, or the unit degrees");
  if (name == "km")
    return {name, *radius_km, "km^2", *radius_km * *radius_km};
  return {name, name == "degrees" ? 180 / std::numbers::pi : 1, "steradians", 1};
}

} // namespace calotte
