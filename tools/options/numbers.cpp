// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/numbers.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <limits>
#include <system_error>

namespace calotte::tools {

std::string shortest(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string formatted(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const std::string range = most == std::numeric_limits<int>::max()
                                ? ">= " + std::to_string(least)
                                : "from " + std::to_string(least) + " to " + std::to_string(most);
  return {[=](std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* const end = text.data() + text.size();
            const auto [stop, problem] = std::from_chars(text.data(), end, value);
            if (problem != std::errc() || stop != end || value < least || value > most)
              return "\"" + text + "\" is not an integer " + range;
            text = std::to_string(value); // CLI11 takes leading zeros for octal
            return "";
          },
          "N"};
}

CLI::Validator whole_number_or_auto(std::uint64_t least, std::uint64_t most) {
  const auto check = [number = whole_number(least, most)](std::string& text) {
    return text == "auto" ? std::string() : number(text);
  };
  return {check, "N|auto"};
}

} // namespace calotte::tools
