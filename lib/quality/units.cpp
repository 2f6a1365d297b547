// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "quality/room.h"

#include <calotte/quality.h>

#include <cmath>
#include <numbers>

namespace calotte {

using base_detail::require;

Unit unit_of(const std::optional<std::string>& units, std::optional<double> radius_km) {
  const std::string name = units.value_or(radius_km ? "km" : "degrees");
  require(name == "km" || name == "degrees" || name == "radians",
          "the unit \"{}\" is unknown; give km, degrees or radians", name);
  require(!radius_km || (*radius_km > 0 && std::isfinite(*radius_km)),
          "the radius of the sphere is {} km; give a positive number", radius_km.value_or(0));
  require(name != "km" || radius_km.has_value(),
          "km need the radius of the sphere; give it, or the unit degrees");
  if (name == "km")
    return {name, *radius_km, "km^2", *radius_km * *radius_km};
  return {name, name == "degrees" ? 180 / std::numbers::pi : 1, "steradians", 1};
}

} // namespace calotte
