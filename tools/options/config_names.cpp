// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/config_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace calotte::tools {

std::string BorrowedName::ours(const std::string& value) const {
  if (values.empty())
    return value;
  for (const Value& known : values)
    if (value == known.word || (value == known.number && !known.number.empty()))
      return known.ours;
  return "";
}

std::string BorrowedName::known() const {
  std::string list;
  for (const Value& value : values) {
    list += list.empty() ? "" : ", ";
    list += value.number.empty() ? value.word : value.number + " (" + value.word + ")";
  }
  return list;
}

const std::vector<BorrowedName>& borrowed_names() {
  static const std::vector<BorrowedName> names{
      {"convergence_criteria", {"tolerance"}, {}, ""},
      {"maximum_iterations", {"max-iterations"}, {}, ""},
      {"quadrature_rule",
       {"rule", "final-rule"},
       {{"0", "centroid", "1"},
        {"3", "7-point", "7"},
        {"4", "13-point", "13"},
        {"5", "19-point", "19"}},
       "MPI-SCVT's 1 (vertex) and 2 (midpoint) are not here"},
      {"sort_method",
       {"sort"},
       {{"0", "distance", "distance"}, {"1", "voronoi", "voronoi"}, {"", "halo", "halo"}},
       ""},
  };
  return names;
}

std::string hyphenated(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

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
    const std::size_t distance = edit_distance(hyphenated(name), hyphenated(other));
    if (distance < least) {
      least = distance;
      nearest = other;
    }
  }
  return nearest;
}

} // namespace calotte::tools
