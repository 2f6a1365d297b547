// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/help.h"

#include "help/guides.h"
#include "help/option_text.h"
#include "help/topics.h"
#include "help/wrapped.h"
#include "text/text.h"

#include <CLI/App.hpp>

#include <algorithm>
#include <memory>
#include <utility>

namespace calotte::tools {
namespace {

constexpr std::size_t text_column = 28; ///< where the texts of options begin

// ---- One option

std::string plain_head(const CLI::Option& option) {
  const std::string values = values_of(option);
  const std::string names = listed(names_of(option), ",", ",");
  return message("  {}{}", names, values.empty() || names == values ? "" : " " + values);
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
  bool shown(const CLI::Option& option, bool all) const {
    return all || help_.common.empty() ||
           std::any_of(help_.common.begin(), help_.common.end(),
                       [&](const std::string& name) { return option.check_name(name); });
  }

  /// The options in their groups; the names of the groups stand where there are several.
  std::string options(const CLI::App& app, bool all) const {
    std::string text;
    for (const auto& [name, members] : groups_of(app)) {
      std::string lines;
      for (const CLI::Option* option : members)
        if (shown(*option, all))
          lines += wrapped(plain_head(*option), text_column,
                           all ? whole_text(*option) : brief_text(*option));
      if (!lines.empty())
        text += (all && !text.empty() ? "\n" : "") + name + ":\n" + lines;
    }
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
             : message("calotte {} --help-all lists all options and the exit codes",
                       app.get_name())) +
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
                       wrapped("", 0, app->get_description()) + examples + "\nCommands:\n";
    for (const CLI::App* command : app->get_subcommands({}))
      text +=
          wrapped("  " + command->get_name(), indent, first_sentence(command->get_description()));
    text += "\nHelp:\n";
    text += wrapped("", indent_of_help,
                    "calotte COMMAND --help shows the common options of a command, "
                    "--help-all all.");
    text +=
        wrapped("", indent_of_help, "calotte help WORD explains " + listed(words(), " or ") + ".");
    return text + "  The manual is in " + manual_folder() + "\n";
  }

private:
  static constexpr const char* examples = R"(
Examples:
  calotte cvt --cell-width 120km --for mpas-ocean -o earth.nc
  calotte cvt --region box=-20,30,40,60 --cell-width 60km --limited-area -o europe.nc
  calotte cull earth.nc --land coast.geojson -o ocean.nc
  calotte view ocean.nc --open
)";

  /// The words that help explains: topics, and the names of guides.
  static std::vector<std::string> words() {
    std::vector<std::string> names;
    for (const Topic& topic : topics())
      names.push_back(topic.name);
    for (const Guide& guide : guides())
      names.push_back(guide.words.substr(0, guide.words.find(' ')));
    return names;
  }

  static constexpr std::size_t indent_of_help = 2;
  static constexpr std::size_t indent = 15; ///< of the texts behind the longest name, interpolate
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
