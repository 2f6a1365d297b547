// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/sphere_radius_option.h"

#include "options/warning.h"
#include "text/text.h"

#include <CLI/App.hpp>

#include <cmath>

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
               : "\"" + text + "\" is not a number; give metres, or earth";
  };
  command.add_option_function<double>("--sphere-radius", set, help)
      ->transform(CLI::Validator(translate, ""))
      ->type_name("METRES");
}

void require_sphere_radius(double metres) {
  if (!(metres > 0) || !std::isfinite(metres))
    refuse("--sphere-radius " + shortest(metres) +
           " is not a positive number; give one such as 6371229, in metres");
}

void warn_of_radius(double metres, const std::string& origin) {
  constexpr double least = 1000, most = 10000;
  if (metres >= least && metres <= most)
    warn(origin + ": a sphere with a radius of " + shortest(metres) +
         " m is small; if these are km, give --sphere-radius " + formatted("%.10g", 1000 * metres) +
         ", or --sphere-radius earth (" + shortest(earth_radius) + " m)");
}

} // namespace calotte::tools
