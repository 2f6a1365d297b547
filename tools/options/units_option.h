// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <calotte/quality.h>

#include <optional>
#include <string>

namespace calotte::tools {

/// Adds --units: km, degrees or radians.
void add_units(CLI::App& command, std::optional<std::string>& word);

/// The unit of --units, see calotte::unit_of().
/// \throws Error invalid_argument for km without a radius.
Unit unit_of(const std::optional<std::string>& word, std::optional<double> radius_km);

} // namespace calotte::tools
