// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/guides.h"

#include "help/option_text.h"
#include "help/topics.h"
#include "help/wrapped.h"
#include "text/text.h"

#include <CLI/App.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace calotte::tools {
namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) {
    return c == '_' ? '-' : static_cast<char>(std::tolower(c));
  });
  return text;
}

bool has_word(const std::string& words, const std::string& word) {
  std::istringstream in(words);
  for (std::string each; in >> each;)
    if (each == word || each + "s" == word)
      return true;
  return false;
}

/// The options of a command whose names or texts have a word, a line for each.
std::vector<std::string> options_with(const CLI::App& command, const std::string& word) {
  std::vector<std::string> lines;
  for (const auto& [group, options] : groups_of(command))
    for (const CLI::Option* option : options) {
      const std::string names = listed(names_of(*option), ",", ",");
      if (lower(names + " " + whole_text(*option)).find(word) != std::string::npos)
        lines.push_back(
            wrapped(message("  {} {}", command.get_name(), names), 32, brief_text(*option)));
    }
  return lines;
}

} // namespace

std::string guide_on(const std::string& word) {
  for (const Guide& guide : guides())
    if (has_word(guide.words, lower(word)))
      return message("{}\nManual: {}, in {}\n", guide.text, listed(split(guide.pages, ' ')),
                     manual_folder());
  return "";
}

std::string mentions_of(const CLI::App& app, const std::string& word) {
  constexpr std::size_t fewest = 3, most = 12; // letters; lines
  const std::string wanted = lower(word);
  if (wanted.size() < fewest)
    return "";
  std::vector<std::string> lines, names;
  for (const CLI::App* command : app.get_subcommands({}))
    for (std::string& line : options_with(*command, wanted))
      lines.push_back(std::move(line));
  for (const Topic& topic : topics())
    if (lower(topic.text).find(wanted) != std::string::npos)
      names.push_back("calotte help " + topic.name);
  std::string text;
  for (std::size_t k = 0; k < std::min(most, lines.size()); ++k)
    text += (k == 0 ? message("Options that mention \"{}\":\n", word) : "") + lines[k];
  if (lines.size() > most)
    text += message("  and {} more\n", lines.size() - most);
  if (!names.empty())
    text += message("Topics that mention \"{}\": {}\n", word, listed(names));
  return text;
}

std::string manual_folder() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const char* folder : {"../share/doc/calotte/tools/manual", // of the folder of a release
                             "../../../tools/manual"}) // of a clone, whose build/release has it
    if (const fs::path found = (program.parent_path() / folder).lexically_normal();
        fs::exists(found / "index.md", error))
      return found.string();
  return "tools/manual of the sources";
}

} // namespace calotte::tools
