// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/shapes/room.h"
#include "io/toml.h"

#include <calotte/error.h>
#include <calotte/widths.h>

#include <cmath>
#include <optional>
#include <set>
#include <string>

namespace calotte::io_detail {

/// One table of a file. Tracks which of its keys have been taken.
class RuleTable {
public:
  RuleTable(const std::string& path, const toml::table& table) : path_(path), table_(table) {}

  bool has(const std::string& key) const { return table_.contains(key); }

  [[noreturn]] void refuse(const std::string& key, const std::string& problem) const {
    const toml::node* const node = table_.get(key);
    fail_at(path_, (node != nullptr ? node->source() : table_.source()).begin.line, "{} {}", key,
            problem);
  }

  /// Whether the table has a key that was not taken before. Takes it.
  bool takes(const std::string& key) { return taken_.insert(key).second && has(key); }

  const toml::node* take(const std::string& key) {
    taken_.insert(key);
    return table_.get(key);
  }

  double number(const std::string& key) {
    const toml::node* const node = take(key);
    if (node == nullptr)
      fail_at(path_, table_.source().begin.line, "the rule needs {}; give a number", key);
    const std::optional<double> value = node->value<double>();
    if (!value || !(*value > 0) || !std::isfinite(*value))
      refuse(key, "is not a positive number; give one without quotes or unit");
    return *value;
  }

  std::string text(const std::string& key, const std::string& what) {
    const toml::node* const node = take(key);
    const std::optional<std::string> value = node ? node->value_exact<std::string>() : std::nullopt;
    if (!value || value->empty())
      refuse(key, message("is no text; give {} in quotes", what));
    return *value;
  }

  /// Takes "smooth", whether a profile is smooth; false without it.
  bool smooth() {
    if (!has("smooth"))
      return false;
    const std::optional<bool> value = take("smooth")->value_exact<bool>();
    if (!value)
      refuse("smooth", "is neither true nor false; give one of them");
    return *value;
  }

  /// Takes a profile: pairs of numbers, and "smooth".
  WidthProfile pairs(const std::string& key) {
    const toml::node* const node = take(key);
    WidthProfile profile;
    if (const toml::array* const list = node->as_array())
      for (const toml::node& item : *list) {
        const toml::array* const pair = item.as_array();
        const auto at = [&](std::size_t k) {
          return pair != nullptr && pair->size() == 2 ? (*pair)[k].value<double>() : std::nullopt;
        };
        if (!at(0) || !at(1))
          refuse(key, message("holds no pair at place {}; give [[number, width], ...]",
                              profile.nodes.size()));
        profile.nodes.push_back({*at(0), *at(1)});
      }
    if (profile.nodes.empty())
      refuse(key, "holds no pairs; give [[number, width], ...]");
    profile.smooth = smooth();
    return profile;
  }

  /// \throws Error parse, if the least width is above the largest one.
  void require_least_below_most() const {
    const auto number = [&](const char* key) {
      const toml::node* const node = table_.get(key);
      return node == nullptr ? std::nullopt : node->value<double>();
    };
    if (const auto least = number("least"), most = number("most"); least && most && *least > *most)
      refuse("least", message("is {}, above most, {}; exchange them", *least, *most));
  }

  /// \throws Error parse, for a key that was not taken.
  void require_all_taken() const {
    for (const auto& [key, node] : table_)
      if (!taken_.contains(std::string(key.str())))
        fail_at(path_, key.source().begin.line,
                "the rule does not take {}; it takes {}; see calotte help widths", key.str(),
                listed(taken_));
  }

  /// Calls make(). Adds path and line to the messages of its errors.
  template <class Make> auto made(const Make& make) const -> decltype(make()) {
    try {
      return make();
    } catch (const Error& error) {
      if (error.code() != ErrorCode::invalid_argument)
        throw;
      fail_at(path_, table_.source().begin.line, error.what());
    }
  }

private:
  const std::string& path_;
  const toml::table& table_;
  std::set<std::string> taken_;
};

} // namespace calotte::io_detail
