// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/unknown_word.h"

#include "help/guides.h"
#include "help/nearest_name.h"
#include "text/text.h"

#include <CLI/App.hpp>

#include <algorithm>

namespace calotte::tools {
namespace {

bool is_option(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options({}))
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  return names;
}

/// "--tolerence=3" without hyphens and value.
std::string bare_name(const std::string& option) {
  const std::string name = option.substr(option.find_first_not_of('-'));
  return name.substr(0, name.find('='));
}

/// The command line that helps with an unknown word: that of a subject of this name, or else
/// `help`.
std::string help_with(const std::string& word, const std::string& help) {
  return guide_on(word).empty() ? help : "calotte help " + word;
}

/// The commands that have an option, such as "calotte refine and calotte coarsen"; "" if none has.
std::string commands_with(const CLI::App& main, const std::string& option) {
  std::vector<std::string> names;
  for (const CLI::App* command : main.get_subcommands({}))
    if (command->get_option_no_throw("--" + option) != nullptr)
      names.push_back("calotte " + command->get_name());
  return listed(names, " and ", " and ");
}

/// What to do about an option that a command does not know.
std::string remedy_for_option(const CLI::App& main, const CLI::App& app, const std::string& name,
                              const std::string& help) {
  if (name.size() == 1 && app.get_option_no_throw("-" + name) != nullptr)
    return message("did you mean -{}? See {}", name, help);
  const std::vector<std::string> own = option_names(app);
  const std::string others = nearest_name(name, own).empty() ? commands_with(main, name) : "";
  return others.empty() ? remedy_for(name, own, "--", help_with(name, help))
                        : message("it is one of {}; see {}", others, help);
}

/// \param app that was given the words, of which it does not know the options.
std::string unknown_option(const CLI::App& main, const CLI::App& app,
                           const std::vector<std::string>& words, const std::string& help) {
  const auto word = std::find_if(words.begin(), words.end(), [](const std::string& text) {
    return is_option(text) && text.find_first_not_of('-') != std::string::npos;
  });
  if (word == words.end())
    return "";
  const std::string name = bare_name(*word);
  return message("unknown option {}; {}", word->substr(0, word->find('=')),
                 remedy_for_option(main, app, name, help));
}

} // namespace

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({}))
    names.push_back(command->get_name());
  return names;
}

std::string help_of(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return message("calotte {}--help", commands.empty() ? "" : commands.back()->get_name() + " ");
}

std::string unknown_word(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining();
  const auto commands = app.get_subcommands();
  if (commands.empty() && !words.empty() && !is_option(words.front()))
    return message(
        "unknown command {}; {}", words.front(),
        remedy_for(words.front(), command_names(app), "", help_with(words.front(), help_of(app))));
  const std::string unknown = unknown_option(app, app, words, "calotte --help");
  if (!unknown.empty() || commands.empty())
    return unknown;
  return unknown_option(app, *commands.back(), commands.back()->remaining(), help_of(app));
}

} // namespace calotte::tools
