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

/// \param app that was given the words, of which it does not know the options.
std::string unknown_option(const CLI::App& app, const std::vector<std::string>& words,
                           const std::string& help) {
  const auto word = std::find_if(words.begin(), words.end(), [](const std::string& text) {
    return is_option(text) && text.find_first_not_of('-') != std::string::npos;
  });
  if (word == words.end())
    return "";
  const std::string name = bare_name(*word);
  return message("unknown option {}; {}", word->substr(0, word->find('=')),
                 remedy_for(name, option_names(app), "--", help_with(name, help)));
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
  const std::string unknown = unknown_option(app, words, "calotte --help");
  if (!unknown.empty() || commands.empty())
    return unknown;
  return unknown_option(*commands.back(), commands.back()->remaining(), help_of(app));
}

} // namespace calotte::tools
