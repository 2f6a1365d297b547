// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace calotte::tools {

/// Adds an option whose value is one of several words; the first is the default.
template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& names, Value& value,
                        const std::vector<std::pair<std::string, Value>>& choices,
                        const std::string& help) {
  std::vector<std::string> words;
  for (const auto& choice : choices)
    words.push_back(choice.first);
  const auto choose = [&value, choices](const std::string& word) {
    const auto is_it = [&](const auto& choice) { return choice.first == word; };
    value = std::find_if(choices.begin(), choices.end(), is_it)->second;
  };
  return command.add_option_function<std::string>(names, choose, help)
      ->check(CLI::IsMember(words))
      ->type_name("WORD")
      ->default_str(words.front());
}

} // namespace calotte::tools
