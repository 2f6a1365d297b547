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

/// "16", "16:32" or "16:32:4"; none for other text.
std::optional<PartCounts> range_of(std::string_view text) {
  std::array<std::int64_t, 3> numbers{0, 0, 1};
  std::size_t count = 0;
  bool valid = true;
  for (const std::string& field : split(text, ':')) {
    std::int32_t number = 0;
    const char* const end = field.data() + field.size();
    const auto [stop, problem] = std::from_chars(field.data(), end, number);
    valid = valid && count < 3 && problem == std::errc() && stop == end && number >= 1;
    if (valid)
      numbers[count++] = number;
  }
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
    for (const std::string& field : split(word, ',')) {
      const std::optional<PartCounts> range = range_of(field);
      require(range.has_value(),
              "\"{}\" is no number of parts; give integers >= 1, or ranges FIRST:LAST:STEP such as "
              "16:512:16",
              field);
      ranges.push_back(*range);
    }
  return ranges;
}

std::vector<std::int64_t> counts_of(const std::vector<PartCounts>& ranges, std::int64_t cells,
                                    const std::string& mesh) {
  std::vector<std::int64_t> counts;
  for (const PartCounts& range : ranges) {
    if (range.last > cells)
      refuse_path(mesh, "{} cells cannot make {} parts; give numbers up to {}", cells, range.last,
                  cells);
    for (std::int64_t count = range.first; count <= range.last; count += range.step)
      counts.push_back(count);
  }
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

} // namespace calotte::tools
