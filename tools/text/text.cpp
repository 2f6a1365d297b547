// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

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

std::string spaced(std::int64_t count) {
  std::string digits = std::to_string(count);
  if (digits.size() > 4)
    for (std::size_t at = digits.size(); at > 3;)
      digits.insert(at -= 3, " ");
  return digits;
}

std::string duration(double seconds) {
  constexpr double minute = 60, hour = 3600;
  const auto number = [](double value) { return formatted(value < 9.95 ? "%.2g" : "%.0f", value); };
  return seconds < 2 * minute ? number(seconds) + " s"
         : seconds < 2 * hour ? number(seconds / minute) + " min"
                              : number(seconds / hour) + " h";
}

std::string data_size(double bytes) {
  const char* unit = "kB";
  double size = bytes / 1000;
  for (const char* const larger : {"MB", "GB", "TB"})
    if (size >= 999.5) { // which three digits would round to 1000
      size /= 1000;
      unit = larger;
    }
  return message("{} {}", formatted("%.3g", size), unit);
}

std::string row(std::string name, std::size_t column, const std::string& value) {
  name.resize(std::max(name.size() + 1, column), ' ');
  return message("{}{}\n", name, value);
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t end = text.find(separator); end != text.npos; end = text.find(separator)) {
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  parts.emplace_back(text);
  return parts;
}

} // namespace calotte::tools
