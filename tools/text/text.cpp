// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/text.h"

#include <calotte/error.h>

#include <array>
#include <charconv>
#include <cstdio>

namespace calotte::tools {

void refuse(const std::string& problem) { throw Error(ErrorCode::invalid_argument, problem); }

void refuse_line(const std::string& path, std::int64_t line, const std::string& problem) {
  throw Error(ErrorCode::parse, path + " line " + std::to_string(line) + ": " + problem, line);
}

std::string shortest(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string formatted(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words)
    text.append(&word == &words.front() ? "" : separator).append(word);
  return text;
}

} // namespace calotte::tools
