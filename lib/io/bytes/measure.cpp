// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "base/require.h"

#include <calotte/read.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

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

double seconds_in(const std::string& text) {
  constexpr std::array<std::pair<std::string_view, double>, 4> units{
      {{"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}}};
  const Measure time = measure_of(text).value_or(Measure{});
  const auto* const unit =
      std::ranges::find(units, time.unit, [](const auto& known) { return known.first; });
  base_detail::require(unit != units.end() && time.value > 0 && std::isfinite(time.value),
                       "\"{}\" is no time; give a number and its unit, s, min, h or d, such as "
                       "12.42h",
                       text);
  return time.value * unit->second;
}

} // namespace calotte
