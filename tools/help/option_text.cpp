// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/option_text.h"

#include "text/text.h"

#include <CLI/App.hpp>

#include <algorithm>
#include <set>
#include <string_view>

namespace calotte::tools {
namespace {

std::string without_stop(const std::string& text) {
  return text.substr(0, text.find_last_not_of('.') + 1);
}

std::string name_list(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options)
    names.push_back(option->get_name());
  return listed(names);
}

std::string default_of(const CLI::Option& option) {
  const std::string value = option.get_default_str();
  return value.empty() ? "" : "; default: " + value;
}

/// The same, or what a sentence of the description says of it, without its reason.
std::string default_in_words(const CLI::Option& option) {
  constexpr std::string_view start = ". Default: ";
  const std::string& text = option.get_description();
  const std::size_t at = text.find(start);
  const std::string value =
      at == std::string::npos ? "" : first_sentence(text.substr(at + start.size()));
  return at == std::string::npos ? default_of(option)
                                 : "; default: " + value.substr(0, value.find_first_of(",;:"));
}

/// The words among which its value is; {} if these are not listed.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find(":{"), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos)
    return {};
  return split(type.substr(begin + 2, end - begin - 2), ',');
}

} // namespace

std::string first_sentence(const std::string& text) {
  return without_stop(text.substr(0, text.find(". ")));
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  if (option.get_positional())
    names.push_back(option.get_name(true)); // the positional name alone
  for (const std::string& name : option.get_snames())
    names.push_back("-" + name);
  for (const std::string& name : option.get_lnames())
    names.push_back("--" + name);
  return names;
}

std::string values_of(const CLI::Option& option) {
  if (option.get_expected_max() == 0)
    return "";
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  if (colon == std::string::npos)
    return type == "TEXT" ? "WORD" : type;
  const std::string check = type.substr(colon + 1);
  const bool plain = check.find_first_of("{ ") == std::string::npos;
  const std::string kind = type.substr(0, colon);
  return plain && !check.empty() ? check : kind == "TEXT" ? "WORD" : kind;
}

std::string brief_text(const CLI::Option& option) {
  return first_sentence(option.get_description()) + default_in_words(option) +
         (option.get_required() ? " (required)" : "");
}

std::string whole_text(const CLI::Option& option) {
  std::string text = without_stop(option.get_description()) + default_of(option);
  const std::vector<std::string> choices = choices_of(option);
  if (!choices.empty() && text.find(choices.back()) == std::string::npos)
    text += ". One of " + listed(choices);
  if (const std::string needed = name_list(option.get_needs()); !needed.empty())
    text += ". Requires " + needed;
  if (const std::string excluded = name_list(option.get_excludes()); !excluded.empty())
    text += ". Excludes " + excluded;
  return text + (option.get_required() ? " (required)" : "");
}

OptionGroups groups_of(const CLI::App& command) {
  OptionGroups groups;
  for (const CLI::Option* option : command.get_options({})) {
    if (option == command.get_help_ptr() || option == command.get_help_all_ptr())
      continue;
    const std::string& name = option->get_group();
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const auto& other) { return other.first == name; });
    if (group == groups.end())
      group = groups.insert(groups.end(), {name, {}});
    group->second.push_back(option);
  }
  return groups;
}

} // namespace calotte::tools
