// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/jig_file.h"

#include "io/command.h"
#include "text/jigsaw_options.h"
#include "text/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

namespace calotte::tools {
namespace {

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos)
    return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1));
}

std::string in_case(int (*convert)(int), std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [&](unsigned char c) { return static_cast<char>(convert(c)); });
  return text;
}

} // namespace

JigFile::JigFile(const std::string& path) : path_(path) {
  std::istringstream lines(read_file(path));
  std::int64_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string content = trimmed(std::string_view(line).substr(0, line.find('#')));
    if (content.empty())
      continue;
    const std::size_t equals = content.find('=');
    if (equals == std::string::npos)
      fail_at(path, number, "not a line NAME = VALUE; correct it");
    const std::string name = in_case(std::toupper, trimmed(content.substr(0, equals)));
    const JigsawOption* const option = jigsaw_option(name);
    if (option == nullptr)
      fail_at(path, number, "JIGSAW has no option {}; see calotte help jig", name);
    if (option->use == JigsawUse::refused)
      fail_at(path, number, "{}: {}; leave it out", name, option->what);
    options_[name] = {trimmed(content.substr(equals + 1)), number};
  }
}

const JigFile::Option* JigFile::find(const std::string& name) const {
  const auto found = options_.find(name);
  return found == options_.end() ? nullptr : &found->second;
}

std::optional<std::string> JigFile::text(const std::string& name) const {
  const Option* const option = find(name);
  return option == nullptr || option->value.empty() ? std::nullopt : std::optional(option->value);
}

std::string JigFile::word(const std::string& name, const std::string& usual) const {
  return in_case(std::tolower, text(name).value_or(usual));
}

std::optional<double> JigFile::number(const std::string& name) const {
  const Option* const option = find(name);
  if (option == nullptr)
    return std::nullopt;
  double value = 0;
  const char* const begin = option->value.data() + (option->value.starts_with('+') ? 1 : 0);
  const char* const end = option->value.data() + option->value.size();
  const auto [rest, problem] = std::from_chars(begin, end, value);
  if (problem != std::errc() || rest != end || std::isnan(value))
    refuse(name, message("\"{}\" is no number", option->value));
  return value;
}

std::optional<int> JigFile::whole(const std::string& name) const {
  const std::optional<double> value = number(name);
  constexpr double most = 1e9;
  if (value && !(*value == std::floor(*value) && std::abs(*value) <= most))
    refuse(name, message("\"{}\" is no whole number", *text(name)));
  return value ? std::optional(static_cast<int>(*value)) : std::nullopt;
}

std::optional<int> JigFile::threads() const {
  const std::optional<int> given = whole("NUMTHREAD");
  return given > 0 ? given : std::nullopt;
}

std::string JigFile::file(const std::string& name) const {
  const std::optional<std::string> path = text(name);
  if (!path || path->empty())
    fail_file(path_, "no {}; give the name of a file", name);
  return *path;
}

void JigFile::refuse(const std::string& name, const std::string& problem) const {
  fail_at(path_, find(name)->line, "{}: {}", name, problem);
}

std::vector<std::string> JigFile::ignored() const {
  std::vector<std::pair<std::int64_t, std::string>> lines;
  for (const auto& [name, option] : options_)
    if (const JigsawOption* const known = jigsaw_option(name); known->use == JigsawUse::ignored)
      lines.emplace_back(option.line, message("{} line {}: {} has no effect: {}", path_,
                                              option.line, name, known->what));
  std::sort(lines.begin(), lines.end());
  std::vector<std::string> texts;
  for (auto& [line, text] : lines)
    texts.push_back(std::move(text));
  return texts;
}

} // namespace calotte::tools
