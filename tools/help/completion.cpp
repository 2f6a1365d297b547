// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/completion.h"

#include "help/option_text.h"
#include "help/topics.h"
#include "help/unknown_word.h"
#include "text/text.h"

#include <CLI/App.hpp>

#include <cctype>
#include <sstream>
#include <vector>

namespace calotte::tools {
namespace {

// ---- Values

/// What completes a value: words, file names, or neither.
struct Values {
  std::vector<std::string> words;
  bool files = false;
};

bool is_word(const std::string& text) {
  return !text.empty() && std::islower(static_cast<unsigned char>(text[0])) != 0;
}

/// \param option takes a value: one of its choices, or as its placeholder says: sample|FILE.
Values values_for(const CLI::Option& option) {
  Values values{choices_of(option)};
  std::istringstream parts(values_of(option));
  for (std::string part; std::getline(parts, part, '|');) {
    if (is_word(part))
      values.words.push_back(part);
    for (const char* kind : {"FILE", "FOLDER", "REPORT", "REGION"})
      values.files = values.files || part.starts_with(kind);
  }
  return values;
}

std::vector<const CLI::Option*> listed_options(const CLI::App& command) {
  std::vector<const CLI::Option*> all;
  for (const auto& [name, members] : groups_of(command))
    all.insert(all.end(), members.begin(), members.end());
  return all;
}

/// Its names that begin with a hyphen.
std::vector<std::string> dashed_names(const CLI::Option& option) {
  std::vector<std::string> names = names_of(option);
  if (option.get_positional())
    names.erase(names.begin());
  return names;
}

/// What completes the arguments that are no options.
Values positional_values(const CLI::App& app, const CLI::App& command) {
  Values all;
  if (command.get_name() == "help") {
    all.words = command_names(app);
    for (const Topic& topic : topics())
      all.words.push_back(topic.name);
  }
  for (const CLI::Option* option : listed_options(command))
    if (option->get_positional()) {
      const Values values = values_for(*option);
      all.words.insert(all.words.end(), values.words.begin(), values.words.end());
      all.files = all.files || values.files;
    }
  return all;
}

// ---- bash

std::string bash_values(const Values& values) {
  return (values.words.empty() ? "" : " words='" + joined(values.words, " ") + "'") +
         (values.files ? " files=1" : "");
}

/// The branch of a command: its options, its arguments, and the values of the option before.
std::string bash_command(const CLI::App& app, const CLI::App& command) {
  std::string names = "--help --help-all", cases;
  for (const CLI::Option* option : listed_options(command)) {
    const std::string pattern = joined(dashed_names(*option), "|");
    for (const std::string& name : dashed_names(*option))
      names += " " + name;
    if (!pattern.empty() && !values_of(*option).empty())
      cases += "        " + pattern + ") value=1" + bash_values(values_for(*option)) + " ;;\n";
  }
  return "    " + command.get_name() + ")\n        options='" + names +
         "'\n        case $before in\n" + cases + "        *)" +
         bash_values(positional_values(app, command)) + " ;;\n        esac\n        ;;\n";
}

constexpr const char* bash_begin =
    R"(# bash completion of calotte, made by calotte help --completion bash
_calotte()
{
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
    local options= words= files= value=
    COMPREPLY=()
    # bash splits --option=value into three words.
    if [[ $word == = ]]; then
        word=
    elif [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD-2]}
    fi
    if ((COMP_CWORD == 1)); then
        COMPREPLY=($(compgen -W ')";

constexpr const char* bash_end = R"(    esac
    if [[ -z $value && $word == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$word"))
        return
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    if [[ -n $files ]]; then
        compopt -o filenames 2>/dev/null
        local name
        while IFS= read -r name; do
            COMPREPLY+=("$name")
        done < <(compgen -f -- "$word")
    fi
}
complete -F _calotte calotte
)";

// ---- zsh

/// Quotes a text for a specification of _arguments within single quotes.
std::string zsh_quoted(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c == '\'')
      result += "'\\''";
    else
      result += std::string(c == ':' || c == '[' || c == ']' || c == '\\' ? "\\" : "") + c;
  return result;
}

/// The end of a specification: what a value is called and what completes it.
std::string zsh_values(const std::string& name, const Values& values) {
  // g++ 12 takes ":" + text for a copy that overlaps (-Wrestrict).
  const std::string head = std::string(":").append(zsh_quoted(name)).append(":");
  if (values.files && !values.words.empty())
    return head + "{_alternative \"words\\:word\\:(" + joined(values.words, " ") +
           ")\" \"files\\:file\\:_files\"}";
  if (values.files)
    return head + "_files";
  return head + (values.words.empty() ? " " : "(" + joined(values.words, " ") + ")");
}

std::string zsh_option(const CLI::Option& option) {
  const std::string text = "[" + zsh_quoted(first_sentence(option.get_description())) + "]";
  const std::string values = values_of(option);
  std::string lines;
  for (const std::string& name : dashed_names(option)) {
    const bool is_long = name.starts_with("--");
    lines += "      '*" + name +
             (values.empty() ? ""
              : is_long      ? "="
                             : "+") +
             text + (values.empty() ? "" : zsh_values(values, values_for(option))) + "' \\\n";
  }
  return lines;
}

std::string zsh_command(const CLI::App& app, const CLI::App& command) {
  std::string text = "  " + command.get_name() + ")\n    _arguments \\\n";
  for (const CLI::Option* option : listed_options(command))
    text += zsh_option(*option);
  text += "      '--help[Shows the common options]' \\\n"
          "      '--help-all[Shows all options]' \\\n";
  const Values values = positional_values(app, command);
  return text + "      '*" + zsh_values("argument", values) + "'\n    ;;\n";
}

} // namespace

std::string bash_completion(const CLI::App& app) {
  std::string text = bash_begin + joined(command_names(app), " ") +
                     " --help --help-all --version' -- \"$word\"))\n        return\n    fi\n"
                     "    case ${COMP_WORDS[1]} in\n";
  for (const CLI::App* command : app.get_subcommands({}))
    text += bash_command(app, *command);
  return text + bash_end;
}

std::string zsh_completion(const CLI::App& app) {
  std::string text = "#compdef calotte\n"
                     "# zsh completion of calotte, made by calotte help --completion zsh\n"
                     "if ((CURRENT == 2)); then\n  local -a commands=(\n";
  for (const CLI::App* command : app.get_subcommands({}))
    text += "    '" + command->get_name() + ":" +
            zsh_quoted(first_sentence(command->get_description())) + "'\n";
  text += "  )\n  _describe command commands\n"
          "  _arguments '--help[Shows the commands]' '--help-all[Shows all options]' "
          "'--version[Shows the version]'\n  return\nfi\n"
          "shift words\n((CURRENT--))\ncase $words[1] in\n";
  for (const CLI::App* command : app.get_subcommands({}))
    text += zsh_command(app, *command);
  return text + "esac\n";
}

} // namespace calotte::tools
