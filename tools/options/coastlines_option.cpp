// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/coastlines_option.h"

#include "options/sphere_radius_option.h"

#include <CLI/App.hpp>

#include <cstdint>

namespace calotte::tools {

void add_coastlines(CLI::App& command, std::optional<bool>& asked) {
  command.add_flag_function(
      "--coastlines,!--no-coastlines", [&asked](std::int64_t count) { asked = count > 0; },
      "Draw the coastlines of the earth, or do not; default: draw them, unless a file or an "
      "option gives a radius that is not the earth's within 1%");
}

bool shows_coastlines(std::optional<bool> asked, std::optional<double> radius_km) {
  return asked.value_or(!radius_km || is_earth(*radius_km));
}

} // namespace calotte::tools
