// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/nearest_name.h"

#include "text/text.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace calotte::tools {

std::string hyphenated(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

namespace {

/// A name without what users may write in another way: letters in upper case, underscores.
std::string plain(std::string name) {
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return hyphenated(std::move(name));
}

} // namespace

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1); // distances of the prefixes of a to those of b
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& other : names) {
    const std::size_t distance = edit_distance(plain(name), plain(other));
    if (distance < least) {
      least = distance;
      nearest = other;
    }
  }
  constexpr std::size_t telling = 4; // letters, of the start of a name
  if (nearest.empty() && name.size() >= telling)
    for (const std::string& other : names)
      if (plain(other).starts_with(plain(name)))
        return other;
  return nearest;
}

std::string remedy_for(const std::string& name, const std::vector<std::string>& names,
                       const std::string& mark, const std::string& help) {
  const std::string nearest = nearest_name(name, names);
  return nearest.empty() ? "see " + help
                         : message("did you mean {}{}? See {}", mark, nearest, help);
}

} // namespace calotte::tools
