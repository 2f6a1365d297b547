// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "help/nearest_name.h"
#include "help/topics.h"
#include "help/unknown_word.h"
#include "text/text.h"

#include <CLI/App.hpp>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace calotte::tools {
namespace {

constexpr const char* command_line = "calotte"; ///< before the name of a command

[[noreturn]] void refuse_topic(const CLI::App& app, const std::string& name) {
  std::vector<std::string> names = command_names(app);
  for (const Topic& topic : topics())
    names.push_back(topic.name);
  refuse(message("no help on \"{}\"; {}", name, remedy_for(name, names, "", "calotte --help")));
}

/// \param name of a command or a topic; "" for the main command.
std::string help_on(const CLI::App& app, const std::string& name) {
  constexpr CLI::AppFormatMode mode = CLI::AppFormatMode::Normal;
  if (name.empty()) // app.help() shows the help of the command that runs: this one
    return app.get_formatter()->make_help(&app, command_line, mode);
  for (const Topic& topic : topics())
    if (topic.name == name)
      return topic.text;
  for (const CLI::App* command : app.get_subcommands({}))
    if (command->get_name() == name)
      return command->get_formatter()->make_help(command, message("{} {}", command_line, name),
                                                 mode);
  refuse_topic(app, name);
}

} // namespace

void add_help(CLI::App& app) {
  CLI::App* command = app.add_subcommand("help", "Shows the help of a command or on a topic.");
  auto name = std::make_shared<std::string>();
  command->add_option(
      "NAME", *name,
      "A command, formats, density, region, measures or exit-codes; default: all commands");
  set_help(*command, {{}, {"calotte help cvt", "calotte help density"}});
  command->callback([&app, name] { std::cout << help_on(app, *name); });
}

} // namespace calotte::tools
