// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/sphere_radius_option.h"

#include "options/numbers.h"
#include "options/warning.h"
#include "text/text.h"

#include <calotte/widths.h>

#include <CLI/App.hpp>

namespace calotte::tools {

void add_sphere_radius(CLI::App& command, std::optional<double>& metres, const std::string& help) {
  const auto set = [&metres](const double& value) {
    metres = value;
    warn_of_radius(value, "--sphere-radius");
  };
  const auto translate = [](std::string& text) {
    double value = 0;
    if (text == "earth")
      text = shortest(earth_radius);
    return CLI::detail::lexical_cast(text, value)
               ? std::string()
               : message("\"{}\" is not a number; give metres, or earth", text);
  };
  command.add_option_function<double>("--sphere-radius", set, help)
      ->transform(CLI::Validator(translate, ""))
      ->type_name("METRES");
}

void require_sphere_radius(double metres) {
  require_positive("--sphere-radius", metres, "one such as 6371229, in metres");
}

void warn_of_radius(double metres, const std::string& origin) {
  constexpr double least = 1000, most = 10000;
  if (metres >= least && metres <= most)
    warn(message("{}: a sphere with a radius of {} m is small; if these are km, give "
                 "--sphere-radius {}, or --sphere-radius earth ({} m)",
                 origin, shortest(metres), formatted("%.10g", 1000 * metres), earth_radius));
}

} // namespace calotte::tools
