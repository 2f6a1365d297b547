// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/room.h"

#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>

/// The text of messages. A shared library hides its functions, and the command has them, too: all
/// of them are inline.
namespace calotte::base_detail {

/// A number with all of its digits if these are at most nine, else with six. So a value just beyond
/// a bound does not look like the bound.
inline std::string shortly(double value) {
  const auto with = [value](int digits) {
    char text[32]; // to_chars() is the same in any locale
    const auto end =
        std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
    return std::string(text, end.ptr);
  };
  const std::string nine = with(9);
  double read = 0;
  std::from_chars(nine.data(), nine.data() + nine.size(), read);
  return read == value ? nine : with(6);
}

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

/// A text with one {} for each value. A different number of {} does not compile.
template <class... Values> struct Pattern {
  template <std::size_t size>
  consteval Pattern(const char (&literal)[size]) // NOLINT(google-explicit-constructor): its purpose
      : text(literal, size - 1) {
    std::size_t slots = 0;
    for (std::size_t at = text.find("{}"); at != text.npos; at = text.find("{}", at + 2))
      ++slots;
    if (slots != sizeof...(Values))
      throw "a message has one {} for each value"; // what the compiler then shows
  }

  std::string_view text;
};

/// The pattern with each {} replaced by a text.
inline std::string filled(std::string_view pattern, std::initializer_list<std::string> texts) {
  std::string all;
  for (const std::string& text : texts) {
    const std::size_t brace = pattern.find("{}");
    all.append(pattern.substr(0, brace)).append(text);
    pattern.remove_prefix(brace + 2);
  }
  return all.append(pattern);
}

/// The pattern with each {} replaced by a value: message("site {} is {} km away", i, distance).
template <class... Values>
std::string message(std::type_identity_t<Pattern<Values...>> pattern, const Values&... values) {
  return filled(pattern.text, {shown(values)...});
}

/// Words with commas, or another separator, between them. \param last stands before the last one.
template <class Words>
std::string listed(const Words& words, std::string_view last = ", ",
                   std::string_view between = ", ") {
  std::string list;
  std::size_t left = std::size(words);
  for (const auto& word : words)
    list.append(list.empty() ? "" : left == 1 ? last : between).append(word), --left;
  return list;
}

} // namespace calotte::base_detail
