// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <system_error>

namespace calotte {

std::optional<Measure> measure_of(const std::string& text) {
  const char *begin = text.data(), *const end = begin + text.size();
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (text.empty() || letter(*begin)) // no inf or nan
    return std::nullopt;
  Measure measure;
  auto [stop, problem] = std::from_chars(begin, end, measure.value);
  if (problem != std::errc() || stop[-1] == '.') // 60.nc is a file
    return std::nullopt;
  stop = std::find_if(stop, end, [](char c) { return c != ' '; });
  if (!std::all_of(stop, end, letter))
    return std::nullopt;
  measure.unit.assign(stop, end);
  return measure;
}

} // namespace calotte
