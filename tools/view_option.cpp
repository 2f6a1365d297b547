// SPDX-License-Identifier: GPL-3.0-or-later
#include "view_option.h"

#include "options/numbers.h"
#include "text/text.h"

#include <CLI/App.hpp>

#include <cmath>

namespace calotte::tools {

CLI::Option* add_view(CLI::App& command, std::optional<LonLat>& place, const std::string& purpose) {
  const auto set = [&place](const std::string& text) {
    const auto degrees = numbers_of<2>(text);
    require(
        degrees && std::abs((*degrees)[0]) <= 360 && std::abs((*degrees)[1]) <= 90,
        "--view {} is not a location; give longitude and latitude in degrees, as in --view 15,-30",
        text);
    place = {(*degrees)[0], (*degrees)[1]};
  };
  return command.add_option_function<std::string>("--view", set, purpose)->type_name("LON,LAT");
}

} // namespace calotte::tools
