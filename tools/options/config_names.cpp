// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/config_names.h"

#include "text/text.h"

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
  std::vector<std::string> list;
  for (const Value& value : values)
    list.push_back(value.number.empty() ? value.word
                                        : message("{} ({})", value.number, value.word));
  return listed(list);
}

const std::vector<BorrowedName>& borrowed_names() {
  static const std::vector<BorrowedName> names{
      {"convergence_criteria", "tolerance", {}},
      {"maximum_iterations", "max-iterations", {}},
      {"sort_method",
       "sort",
       {{"0", "distance", "distance"}, {"1", "voronoi", "voronoi"}, {"", "halo", "halo"}}},
  };
  return names;
}

} // namespace calotte::tools
