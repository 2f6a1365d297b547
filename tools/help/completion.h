// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <string>

namespace calotte::tools {

/// A script with which bash completes commands, options, their words, and file names.
/// \param app the main command, after all commands are added.
std::string bash_completion(const CLI::App& app);

/// The same for zsh, with the first sentence of each text.
std::string zsh_completion(const CLI::App& app);

} // namespace calotte::tools
