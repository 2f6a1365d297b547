// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>

#include <string>
#include <vector>

/// The help of the commands: --help, --help-all and calotte help.
namespace calotte::tools {

/// The help of one command.
struct Help {
  std::vector<std::string> common;   ///< names of the options that --help shows; empty: all
  std::vector<std::string> examples; ///< command lines
};

/// Sets the layout of the help of a command, at most 100 columns wide.
///
/// --help shows the common options with the first sentence of their texts, and the examples.
/// --help-all shows all options with their whole texts in their groups, and the exit codes.
void set_help(CLI::App& command, Help help);

/// Sets the layout of the help of the main command: it lists the commands, the topics and the exit
/// codes.
void set_main_help(CLI::App& app);

/// Puts the options that are added to a command during its life in a group of the help.
class OptionGroup {
public:
  OptionGroup(CLI::App& command, const std::string& name)
      : defaults_(*command.option_defaults()), outer_(defaults_.get_group()) {
    defaults_.group(name);
  }
  ~OptionGroup() { defaults_.group(outer_); }
  OptionGroup(const OptionGroup&) = delete;
  OptionGroup& operator=(const OptionGroup&) = delete;

private:
  CLI::OptionDefaults& defaults_;
  std::string outer_;
};

} // namespace calotte::tools
