// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <optional>
#include <string>

namespace calotte::tools {

/// A unit of distances on the sphere, and of areas.
struct Unit {
  std::string name;        ///< of a distance
  double of_radian = 1;    ///< distances: the value of one radian
  std::string area;        ///< name of the unit of areas
  double of_steradian = 1; ///< areas: the value of one steradian
};

/// Adds --units: km, degrees or radians.
void add_units(CLI::App& command, std::optional<std::string>& word);

/// The unit of a word. Default: km if the radius of the sphere is known, else degrees.
/// \throws Error invalid_argument for km without a radius.
Unit unit_of(const std::optional<std::string>& word, std::optional<double> radius_km);

} // namespace calotte::tools
