// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <memory>
#include <set>
#include <string>

namespace calotte::tools {

/// Adds --config FILE: the command's options from a TOML file, by their long names, with hyphens or
/// underscores, or by those of MPI-SCVT (see config_names.h). Add it last.
///
/// - The command line takes precedence. Options that it excludes, and options that need those, are
///   ignored in the file.
/// - An option that may be given several times takes an array, a flag true or false. A number may
///   be in quotes.
/// - Tables may group keys, one level deep; their names have no effect.
/// - Names of files that are read are relative to the folder of the TOML file; those of files that
///   are written, such as --output, to the current folder. They are the values of options whose
///   type_name ends in FILE; words before it, as in sample|fibonacci|FILE, and "-" are no files. Of
///   SHAPE|FILE it is the file that the word of a region names, by region_beside().
///
/// \param others names of options of another command, whose files may hold them; they have no
///        effect.
/// (CLI11's own set_config serves the main command alone and reads a part of TOML.)
/// \return the file's name, once the options are parsed; "" if there is none. The parsing throws
///         Error file, parse, and invalid_argument naming the file, the line and the nearest known
///         name.
std::shared_ptr<std::string> add_config(CLI::App& command,
                                        const std::set<std::string>& others = {});

/// All options given to a command, by the command line or a file, one value a line.
std::string given_options(const CLI::App& command);

/// Applies such lines, unless the command line or a TOML file overrules them, as add_config() does.
/// \param path the file that holds them, for messages.
void apply_options(CLI::App& command, const std::string& lines, const std::string& path);

} // namespace calotte::tools
