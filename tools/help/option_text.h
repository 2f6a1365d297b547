// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <string>
#include <utility>
#include <vector>

/// What help says about an option.
namespace calotte::tools {

/// The first sentence of a text, without its full stop.
std::string first_sentence(const std::string& text);

/// Its names as a command line has them: START, -o, --output.
std::vector<std::string> names_of(const CLI::Option& option);

/// The placeholder of its values, without words for their validation: FILE, N, KM; "" for a flag.
std::string values_of(const CLI::Option& option);

/// The first sentence of its text, with its default.
std::string brief_text(const CLI::Option& option);

/// Its text with its default, its choices, and the options that it requires and excludes.
std::string whole_text(const CLI::Option& option);

/// The options of a command in their groups, without --help and --help-all.
using OptionGroups = std::vector<std::pair<std::string, std::vector<const CLI::Option*>>>;
OptionGroups groups_of(const CLI::App& command);

} // namespace calotte::tools
