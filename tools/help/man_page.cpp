// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/man_page.h"

#include "help/help.h"
#include "help/option_text.h"
#include "help/topics.h"

#include <calotte/version.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <cctype>

namespace calotte::tools {
namespace {

// ---- roff

/// Escapes what roff would interpret: backslashes, hyphens, and a dot or quote that begins a line.
std::string escaped(const std::string& text) {
  std::string result;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\''))
      result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
    begins = c == '\n';
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

/// A text as it stands, in lines of one width. Empty lines separate its paragraphs.
std::string verbatim(const std::string& text) {
  std::string lines = ".nf\n";
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    lines += line.empty() ? ".sp\n" : escaped(line) + "\n";
    begin = end + 1;
  }
  return lines + ".fi\n";
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The first letter in lower case, as after the dash of a section NAME.
std::string lowered(std::string text) {
  text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

// ---- Sections

std::string title(const std::string& name, const std::string& summary) {
  return ".\\\" Made by calotte help --man.\n.TH " + escaped(upper(name)) +
         " 1 \"\" \"calotte " CALOTTE_VERSION "\" \"Calotte manual\"\n.SH NAME\n" + escaped(name) +
         " \\- " + escaped(lowered(summary)) + "\n";
}

std::string man_head(const CLI::Option& option) {
  std::string head;
  for (const std::string& name : names_of(option))
    head += (head.empty() ? "" : ", ") + (name[0] == '-' ? bold(name) : italic(name));
  const std::string values = values_of(option);
  if (!values.empty())
    head.append(" ").append(italic(values)); // with +, a false -Wrestrict of g++ 12
  return head;
}

std::string options(const CLI::App& command) {
  std::string text = ".SH OPTIONS\n";
  const OptionGroups groups = groups_of(command);
  for (const auto& [name, members] : groups) {
    if (groups.size() > 1)
      text += ".SS " + escaped(name) + "\n";
    for (const CLI::Option* option : members)
      text += ".TP\n" + man_head(*option) + "\n" + escaped(whole_text(*option)) + ".\n";
  }
  return text;
}

std::string synopsis(const CLI::App& command) {
  std::string text = ".SH SYNOPSIS\n" + bold("calotte " + command.get_name()) + " [OPTIONS]";
  for (const CLI::Option* option : command.get_options({}))
    if (option->get_positional()) {
      const std::string name = italic(option->get_name(true));
      text += option->get_required() ? " " + name : " [" + name + "]";
    }
  return text + "\n";
}

std::string examples(const CLI::App& command) {
  std::string text;
  for (const std::string& line : examples_of(command))
    text += line + "\n";
  return text.empty() ? "" : ".SH EXAMPLES\n" + verbatim(text);
}

std::string exit_status() { return ".SH \"EXIT STATUS\"\n" + verbatim(exit_codes()); }

std::string see_also(const CLI::App& app, const std::string& without) {
  std::string list = without == "calotte" ? "" : bold("calotte") + "(1)";
  for (const CLI::App* command : app.get_subcommands({}))
    if (const std::string name = "calotte-" + command->get_name(); name != without)
      list += (list.empty() ? "" : ", ") + bold(name) + "(1)";
  return ".SH \"SEE ALSO\"\n" + list + "\n";
}

} // namespace

std::string man_page(const CLI::App& app) {
  std::string text = title("calotte", first_sentence(app.get_description())) + ".SH SYNOPSIS\n" +
                     bold("calotte") + " " + italic("COMMAND") + " [OPTIONS]\n.SH DESCRIPTION\n" +
                     escaped(app.get_description()) +
                     "\nEach command has a manual page, such as \\fBcalotte\\-cvt\\fR(1).\n"
                     ".SH COMMANDS\n";
  for (const CLI::App* command : app.get_subcommands({}))
    text += ".TP\n" + bold(command->get_name()) + "\n" + escaped(command->get_description()) + "\n";
  for (const Topic& topic : topics())
    if (topic.name != "exit-codes")
      text += ".SH " + upper(topic.name) + "\n" + verbatim(topic.text);
  return text + exit_status() + see_also(app, "calotte");
}

std::string man_page(const CLI::App& app, const CLI::App& command) {
  const std::string name = "calotte-" + command.get_name();
  return title(name, first_sentence(command.get_description())) + synopsis(command) +
         ".SH DESCRIPTION\n" + escaped(command.get_description()) + "\n" + options(command) +
         examples(command) + exit_status() + see_also(app, name);
}

} // namespace calotte::tools
