// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <string>
#include <vector>

namespace calotte::tools {

/// The names of the commands.
std::vector<std::string> command_names(const CLI::App& app);

/// The command line that prints the help for the given arguments: "calotte cvt --help".
std::string help_of(const CLI::App& app);

/// A message about the first command or option of the command line that is unknown, with the
/// nearest one that is known; "" if all are known.
/// \param app the main command, after it has read its arguments.
std::string unknown_word(const CLI::App& app);

} // namespace calotte::tools
