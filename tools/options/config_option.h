// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace calotte::tools {

/// Adds --config FILE: the command's options from a TOML file, by their long names, with hyphens or
/// underscores, or by those of MPI-SCVT (see config_names.h). Add it last.
///
/// - What the command line gives wins; what it excludes is left out, and what needs that.
/// - An option that may be given several times takes an array, a flag true or false. A number may
///   stand in quotes.
/// - Tables group keys as one likes, one deep; their names mean nothing.
/// - Files are sought from the folder of the TOML file, wherever the command runs. They are the
///   values of options whose type_name ends in FILE; words before it, as in sample|fibonacci|FILE,
///   and "-" are no files.
///
/// (CLI11's own set_config serves the main command alone and reads a part of TOML.)
/// \return the file's name, once the options are parsed; "" where there is none. The parsing throws
///         Error file, parse, and bad_option naming the file, the line and the nearest known name.
std::shared_ptr<std::string> add_config(CLI::App& command);

} // namespace calotte::tools
