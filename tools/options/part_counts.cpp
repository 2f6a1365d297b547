// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/part_counts.h"

#include "text/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace calotte::tools {
namespace {

/// Calls body(field) for the text between separators.
template <class Body> void for_each_field(std::string_view text, char separator, const Body& body) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    body(text.substr(begin, end - begin));
    begin = end + 1;
  }
}

/// "16", "16:32" or "16:32:4"; none for other text.
std::optional<PartCounts> range_of(std::string_view text) {
  std::array<std::int64_t, 3> numbers{0, 0, 1};
  std::size_t count = 0;
  bool valid = true;
  for_each_field(text, ':', [&](std::string_view field) {
    std::int32_t number = 0;
    const char* const end = field.data() + field.size();
    const auto [stop, problem] = std::from_chars(field.data(), end, number);
    valid = valid && count < 3 && problem == std::errc() && stop == end && number >= 1;
    if (valid)
      numbers[count++] = number;
  });
  if (count == 1)
    numbers[1] = numbers[0];
  if (!valid || numbers[0] > numbers[1])
    return std::nullopt;
  return PartCounts{numbers[0], numbers[1], numbers[2]};
}

} // namespace

std::vector<PartCounts> part_counts(const std::vector<std::string>& words) {
  std::vector<PartCounts> ranges;
  for (const std::string& word : words)
    for_each_field(word, ',', [&](std::string_view field) {
      const std::optional<PartCounts> range = range_of(field);
      if (!range)
        refuse("\"" + std::string(field) +
               "\" is no number of parts; give integers >= 1, or ranges FIRST:LAST:STEP such as "
               "16:512:16");
      ranges.push_back(*range);
    });
  return ranges;
}

std::vector<std::int64_t> counts_of(const std::vector<PartCounts>& ranges, std::int64_t cells,
                                    const std::string& mesh) {
  std::vector<std::int64_t> counts;
  for (const PartCounts& range : ranges) {
    if (range.last > cells)
      refuse(mesh + ": " + std::to_string(cells) + " cells cannot make " +
             std::to_string(range.last) + " parts; give numbers up to " + std::to_string(cells));
    for (std::int64_t count = range.first; count <= range.last; count += range.step)
      counts.push_back(count);
  }
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

} // namespace calotte::tools
