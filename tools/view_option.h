// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"
#include "help/cli_forward.h"

#include <optional>
#include <string>

namespace calotte::tools {

/// Adds --view LON,LAT. \param purpose of the place.
CLI::Option* add_view(CLI::App& command, std::optional<LonLat>& place, const std::string& purpose);

} // namespace calotte::tools
