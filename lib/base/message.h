// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/room.h"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>

/// The text of messages.
namespace calotte::base_detail {

/// A number as it was given, if nine digits hold it, else with six. So a value that misses a bound
/// by little does not look like the bound.
std::string shortly(double value);

/// A value as messages show it, see shortly().
template <class Value> std::string shown(const Value& value) {
  if constexpr (std::integral<Value>) {
    static_assert(!std::same_as<Value, bool> && !std::same_as<Value, char>, "say it in words");
    return std::to_string(value);
  } else if constexpr (std::floating_point<Value>) {
    return shortly(value);
  } else {
    return std::string(value);
  }
}

/// "1 row", "2 rows".
inline std::string counted(std::int64_t number, const std::string& thing) {
  return std::to_string(number) + ' ' + thing + (number == 1 ? "" : "s");
}

/// A text with one {} for each of some values; another number of them does not compile.
template <class... Values> struct Pattern {
  template <std::size_t size>
  consteval Pattern(const char (&literal)[size]) // NOLINT(google-explicit-constructor): its purpose
      : text(literal, size - 1) {
    std::size_t places = 0;
    for (std::size_t at = text.find("{}"); at != text.npos; at = text.find("{}", at + 2))
      ++places;
    if (places != sizeof...(Values))
      throw "a message has one {} for each value"; // what the compiler then shows
  }

  std::string_view text;
};

/// The pattern with the texts in place of its {}.
std::string filled(std::string_view pattern, std::initializer_list<std::string> texts);

/// The pattern with the values in place of its {}: message("site {} is {} km away", i, distance).
template <class... Values>
std::string message(std::type_identity_t<Pattern<Values...>> pattern, const Values&... values) {
  return filled(pattern.text, {shown(values)...});
}

/// Words with commas between them. \param last stands before the last one.
template <class Words> std::string listed(const Words& words, std::string_view last = ", ") {
  std::string list;
  std::size_t left = std::size(words);
  for (const auto& word : words)
    list.append(list.empty() ? "" : left == 1 ? last : ", ").append(word), --left;
  return list;
}

} // namespace calotte::base_detail
