// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <optional>
#include <string>

/// The global MPAS file from which a command takes a part, and the name of that part.
namespace calotte::tools {

/// Adds the positional option GLOBAL.
void add_global(CLI::App& command, std::string& path);

/// \throws Error invalid_argument for a file that is no NetCDF file; file.
void require_mpas_source(const std::string& path);

/// \throws Error invalid_argument unless the name is that of a complete MPAS file.
void require_mpas_name(const std::string& output);

/// \param model the word of --for, if given.
/// \throws Error invalid_argument for a model that reads other formats.
void require_mpas_model(const std::optional<std::string>& model);

} // namespace calotte::tools
