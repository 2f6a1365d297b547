// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/guides.h"
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
  for (const Guide& guide : guides())
    for (const std::string& word : split(guide.words, ' '))
      if (constexpr std::size_t shortest = 5; word.size() >= shortest) // others are near any word
        names.push_back(word);
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
  std::string text = guide_on(name);
  for (const std::string& word : split(name, '-')) // such as of sea-ice
    if (text.empty())
      text = guide_on(word);
  if (text.empty())
    text = mentions_of(app, name);
  if (!text.empty())
    return text;
  refuse_topic(app, name);
}

} // namespace

void add_help(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("help", "Shows the help of a command, or what there is on a subject.");
  auto words = std::make_shared<std::vector<std::string>>();
  command->add_option(
      "WORD", *words,
      "A command, a topic such as density, or what you have in mind, such as ocean; "
      "default: all commands");
  set_help(*command, {{}, {"calotte help cvt", "calotte help ocean", "calotte help limited area"}});
  command->callback([&app, words] { std::cout << help_on(app, listed(*words, "-", "-")); });
}

void add_version(CLI::App& app) {
  CLI::App* command = app.add_subcommand("version", "Shows the version, as --version does.");
  set_help(*command, {{}, {"calotte version", "calotte --version"}});
  command->callback([&app] { std::cout << app.version() << "\n"; });
}

} // namespace calotte::tools
