// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/config_file.h"

#include "io/toml.h"
#include "text/text.h"

#include <algorithm>
#include <string>
#include <utility>

namespace calotte::tools {
namespace {

/// Converts the nodes of a file to settings.
class Reader {
public:
  explicit Reader(const std::string& path) : path_(path) {}

  std::vector<ConfigSetting> settings(const toml::table& root) {
    if (root.size() == 1 && root["cell-width"].is_table())
      refuse_path(path_, "it holds widths of cells, not options; give --cell-width {}", path_);
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
          fail_at(path_, line,
                  "table {} is nested in table {}; nested tables are not supported; remove the "
                  "inner one",
                  name, group->str());
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
      fail_at(path_, line, "{} is an empty array; leave it out", name);
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
    fail_at(path_, line,
            "{} holds {}; give text in quotes, a number, true or false, or an array of texts or "
            "numbers",
            name,
            node.is_table()   ? "a table"
            : node.is_array() ? "an array"
                              : "a date or time");
  }

  const std::string& path_;
  std::vector<ConfigSetting> settings_;
};

} // namespace

std::vector<ConfigSetting> read_config(const std::string& path) {
  return Reader(path).settings(read_toml(path));
}

} // namespace calotte::tools
