// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/config_file.h"

#include "io/command.h"
#include "text/text.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace calotte::tools {
namespace {

[[noreturn]] void refuse(const std::string& path, std::int64_t line, const std::string& problem) {
  throw Error(ErrorCode::parse, path + " line " + std::to_string(line) + ": " + problem, line);
}

/// The parser's tables call themselves for each part of a key such as a.b.c; here two do for all.
class KeyParts {
public:
  static constexpr int most = 32;

  /// Whether a key of the text has more parts.
  static bool exceeded(std::string_view text) {
    int parts = 1;
    for (std::size_t k = 0; k < text.size(); ++k)
      switch (text[k]) {
      case '"':
      case '\'':
        k = end_of_text(text, k) - 1;
        break;
      case '#':
        k = std::min(text.find('\n', k), text.size()) - 1;
        break;
      case '.':
        if (++parts > most)
          return true;
        break;
      case '\n':
      case '=':
      case ',':
      case '[':
      case ']':
      case '{':
      case '}':
        parts = 1;
        break;
      default:
        break;
      }
    return false;
  }

private:
  /// Past the quote that ends the text which begins there.
  static std::size_t end_of_text(std::string_view text, std::size_t begin) {
    const char quote = text[begin];
    const std::string_view three = text.substr(begin, 3);
    const bool lines = three == std::string(3, quote);
    const std::string end(lines ? 3 : 1, quote);
    for (std::size_t k = begin + end.size(); k < text.size(); ++k)
      if (quote == '"' && text[k] == '\\')
        ++k;
      else if (text.substr(k).starts_with(end))
        return k + end.size();
      else if (!lines && text[k] == '\n') // the parser refuses it
        return k;
    return text.size();
  }
};

/// \throws Error parse for a text that would take much memory or stack.
std::string read_text(const std::string& path) {
  constexpr std::uintmax_t most = std::uintmax_t{1} << 20;
  std::error_code error;
  if (const std::uintmax_t size = std::filesystem::file_size(path, error); !error && size > most)
    throw Error(ErrorCode::parse, path + ": " + std::to_string(size) +
                                      " bytes are too many for a file of options; give a TOML file "
                                      "of at most 1 MiB");
  std::string text = read_file(path);
  if (KeyParts::exceeded(text))
    throw Error(ErrorCode::parse, path + ": a key of more than " + std::to_string(KeyParts::most) +
                                      " parts; write key = value");
  return text;
}

toml::table parse(const std::string& path) {
  try {
    return toml::parse(read_text(path), path);
  } catch (const toml::parse_error& error) {
    refuse(path, error.source().begin.line,
           std::string(error.description()) + "; write key = value, with text in quotes");
  }
}

/// Converts the nodes of a file to settings.
class Reader {
public:
  explicit Reader(const std::string& path) : path_(path) {}

  std::vector<ConfigSetting> settings(const toml::table& root) {
    add(root, nullptr);
    std::stable_sort(settings_.begin(), settings_.end(),
                     [](const auto& a, const auto& b) { return a.line < b.line; });
    return std::move(settings_);
  }

private:
  /// \param group the name of the table, or empty for the top level.
  void add(const toml::table& table, const toml::key* group) {
    for (const auto& [key, node] : table) {
      const std::int64_t line = key.source().begin.line;
      const std::string name(key.str());
      if (const toml::table* inner = node.as_table()) {
        if (group)
          refuse(path_, line,
                 "table " + name + " is nested in table " + std::string(group->str()) +
                     "; nested tables are not supported; remove the inner one");
        add(*inner, &key);
      } else if (const toml::array* array = node.as_array()) {
        settings_.push_back({name, line, values(name, line, *array)});
      } else {
        settings_.push_back({name, line, {value(name, line, node)}});
      }
    }
  }

  std::vector<ConfigValue> values(const std::string& name, std::int64_t line,
                                  const toml::array& array) const {
    std::vector<ConfigValue> list;
    for (const toml::node& node : array)
      list.push_back(value(name, line, node));
    if (list.empty())
      refuse(path_, line, name + " is an empty array; leave it out");
    return list;
  }

  ConfigValue value(const std::string& name, std::int64_t line, const toml::node& node) const {
    using Kind = ConfigValue::Kind;
    if (const auto* truth = node.as_boolean())
      return {Kind::truth, truth->get() ? "true" : "false"};
    if (const auto* integer = node.as_integer())
      return {Kind::number, std::to_string(integer->get())};
    if (const auto* number = node.as_floating_point())
      return {Kind::number, shortest(number->get())};
    if (const auto* text = node.as_string())
      return {Kind::text, text->get()};
    const std::string what = node.is_table()   ? "a table"
                             : node.is_array() ? "an array"
                                               : "a date or time";
    refuse(path_, line,
           name + " holds " + what +
               "; give text in quotes, a number, true or false, or an array of texts or numbers");
  }

  const std::string& path_;
  std::vector<ConfigSetting> settings_;
};

} // namespace

std::vector<ConfigSetting> read_config(const std::string& path) {
  return Reader(path).settings(parse(path));
}

} // namespace calotte::tools
