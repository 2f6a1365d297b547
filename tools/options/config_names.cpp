// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/config_names.h"

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

} // namespace calotte::tools
