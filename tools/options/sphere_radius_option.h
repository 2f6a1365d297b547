// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <optional>
#include <string>

namespace calotte::tools {

/// The Earth's radius in MPAS, in metres: --sphere-radius earth.
inline constexpr double earth_radius = 6371229;

inline constexpr double metres_per_km = 1000;

/// Adds --sphere-radius: metres, or the word earth. A value that may be in km gives a warning.
/// \param help the use of the radius, and its default.
void add_sphere_radius(CLI::App& command, std::optional<double>& metres, const std::string& help);

/// \param metres the value of --sphere-radius.
/// \throws Error invalid_argument for a radius that is not positive and finite.
void require_sphere_radius(double metres);

/// Warns of a radius of 1000 to 10 000 m, which may be in km.
/// \param origin the option or the file that gives it.
void warn_of_radius(double metres, const std::string& origin);

} // namespace calotte::tools
