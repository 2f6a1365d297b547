// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace calotte::tools {

/// Adds --config FILE: the subcommand's options from a TOML file, by their long names. What the
/// command line gives wins. Add it last. (CLI11's own set_config serves the main command alone.)
/// \return the file's name, once the options are parsed; "" where there is none.
std::shared_ptr<std::string> add_config(CLI::App& command);

} // namespace calotte::tools
