// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/help.h"

#include "help/topics.h"

#include <algorithm>
#include <memory>
#include <sstream>
#include <utility>

namespace calotte::tools {
namespace {

constexpr std::size_t columns = 100;
constexpr std::size_t text_column = 28; ///< where the texts of options begin

// ---- Lines

/// Breaks a text into lines of at most 100 columns.
/// \param head the start of the first line; the text begins at `indent`, on the next line if the
///        head is too long.
std::string wrapped(const std::string& head, std::size_t indent, const std::string& text) {
  const std::string margin(indent, ' ');
  std::string lines = head, line = head;
  if (head.size() + 2 > indent && indent > 0) {
    lines += "\n" + margin;
    line = margin;
  } else {
    lines.resize(indent, ' ');
    line.resize(indent, ' ');
  }
  std::istringstream words(text);
  bool first = true;
  for (std::string word; words >> word; first = false) {
    if (!first && line.size() + 1 + word.size() > columns) {
      lines += "\n" + margin;
      line = margin;
    } else if (!first) {
      lines += " ";
      line += " ";
    }
    lines += word;
    line += word;
  }
  return lines + "\n";
}

std::string first_sentence(const std::string& text) {
  const std::string sentence = text.substr(0, text.find(". "));
  return sentence.substr(0, sentence.find_last_not_of('.') + 1);
}

// ---- One option

/// The words for its values, without those for their validation: FILE, N, KM.
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

/// The words among which its value is; "" if these are not listed.
std::string choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find(":{"), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos)
    return "";
  std::string list;
  std::istringstream words(type.substr(begin + 2, end - begin - 2));
  for (std::string word; std::getline(words, word, ',');)
    list += (list.empty() ? "" : ", ") + word;
  return list;
}

std::string names_of(const std::set<CLI::Option*>& options) {
  std::string list;
  for (const CLI::Option* option : options)
    list += (list.empty() ? "" : ", ") + option->get_name();
  return list;
}

std::string head_of(const CLI::Option& option) {
  const std::string values = values_of(option);
  const std::string names = option.get_name(true, true);
  return "  " + names + (values.empty() || names == values ? "" : " " + values);
}

std::string default_of(const CLI::Option& option) {
  const std::string value = option.get_default_str();
  return value.empty() ? "" : "; default: " + value;
}

/// The first sentence of its text.
std::string brief(const CLI::Option& option) {
  return wrapped(head_of(option), text_column,
                 first_sentence(option.get_description()) + default_of(option) +
                     (option.get_required() ? " (required)" : ""));
}

std::string whole(const CLI::Option& option) {
  std::string text = option.get_description() + default_of(option);
  const std::string choices = choices_of(option);
  const bool listed = text.find(choices.substr(choices.rfind(' ') + 1)) != std::string::npos;
  if (!choices.empty() && !listed)
    text += ". One of " + choices;
  if (const std::string needed = names_of(option.get_needs()); !needed.empty())
    text += ". Requires " + needed;
  if (const std::string excluded = names_of(option.get_excludes()); !excluded.empty())
    text += ". Excludes " + excluded;
  return wrapped(head_of(option), text_column, text + (option.get_required() ? " (required)" : ""));
}

// ---- A command

class HelpFormatter : public CLI::Formatter {
public:
  explicit HelpFormatter(Help help) : help_(std::move(help)) {}

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const bool all = mode == CLI::AppFormatMode::All;
    return make_usage(app, std::move(name)) + wrapped("", 0, app->get_description()) + "\n" +
           options(*app, all) + examples() + (all ? "\n" + exit_codes() : further(*app));
  }

private:
  bool shown(const CLI::App& app, const CLI::Option& option, bool all) const {
    if (&option == app.get_help_ptr() || &option == app.get_help_all_ptr())
      return false;
    return all || help_.common.empty() ||
           std::any_of(help_.common.begin(), help_.common.end(),
                       [&](const std::string& name) { return option.check_name(name); });
  }

  /// The options in their groups; the names of the groups stand where there are several.
  std::string options(const CLI::App& app, bool all) const {
    std::vector<std::pair<std::string, std::string>> groups;
    for (const CLI::Option* option : app.get_options({})) {
      if (!shown(app, *option, all))
        continue;
      const std::string& name = option->get_group();
      auto group = std::find_if(groups.begin(), groups.end(),
                                [&](const auto& other) { return other.first == name; });
      if (group == groups.end())
        group = groups.insert(groups.end(), {name, ""});
      group->second += all ? whole(*option) : brief(*option);
    }
    std::string text;
    for (const auto& [name, lines] : groups)
      text += (all && !text.empty() ? "\n" : "") + name + ":\n" + lines;
    return text;
  }

  std::string examples() const {
    if (help_.examples.empty())
      return "";
    std::string text = help_.examples.size() == 1 ? "\nExample:\n" : "\nExamples:\n";
    for (const std::string& example : help_.examples)
      text += "  " + example + "\n";
    return text;
  }

  std::string further(const CLI::App& app) const {
    const bool density = app.get_option_no_throw("--density") != nullptr;
    const std::string text =
        (help_.common.empty()
             ? "calotte help exit-codes lists the exit codes"
             : "calotte " + app.get_name() + " --help-all lists all options and the exit codes") +
        (density ? "; calotte help density describes densities." : ".");
    return "\n" + wrapped("", 0, text);
  }

  Help help_;
};

// ---- The main command

class MainFormatter : public CLI::Formatter {
public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode /*mode*/) const override {
    std::string text = "Usage: " + name + " COMMAND [OPTIONS]\n" +
                       wrapped("", 0, app->get_description()) + "\nCommands:\n";
    for (const CLI::App* command : app->get_subcommands({}))
      text +=
          wrapped("  " + command->get_name(), indent, first_sentence(command->get_description()));
    text += "\nTopics of calotte help:\n";
    for (const Topic& topic : topics())
      text += wrapped("  " + topic.name, indent, topic.summary);
    return text +
           "\ncalotte COMMAND --help shows the common options of a command, --help-all all "
           "of them.\ncalotte --version shows the version.\n\n" +
           exit_codes();
  }

private:
  static constexpr std::size_t indent = 14;
};

} // namespace

void set_help(CLI::App& command, Help help) {
  command.formatter(std::make_shared<HelpFormatter>(std::move(help)));
}

void set_main_help(CLI::App& app) {
  app.formatter(std::make_shared<MainFormatter>());
  app.set_help_all_flag("--help-all", "Shows all options");
}

} // namespace calotte::tools
