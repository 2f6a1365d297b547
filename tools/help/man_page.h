// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <string>

namespace calotte::tools {

/// The manual page of the main command in the macros of man(7): its commands, topics and exit
/// codes.
std::string man_page(const CLI::App& app);

/// The manual page of one command, such as calotte-cvt(1), with all its options.
/// \param app the main command.
std::string man_page(const CLI::App& app, const CLI::App& command);

} // namespace calotte::tools
