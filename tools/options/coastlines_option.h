// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <optional>

namespace calotte::tools {

/// Adds --coastlines and --no-coastlines. \param asked what is given, if anything.
void add_coastlines(CLI::App& command, std::optional<bool>& asked);

/// Whether a map of a sphere shows the coastlines of the earth. Default: unless the radius of the
/// sphere is known and is not the earth's.
bool shows_coastlines(std::optional<bool> asked, std::optional<double> radius_km);

} // namespace calotte::tools
