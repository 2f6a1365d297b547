// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_actions.h"

#include "text/text.h"

#include <calotte/grid.h>

namespace calotte::tools {

std::string described(const CvtAction& action) {
  std::string text = std::to_string(action.cells) + " cells";
  if (action.times > 1)
    text += ", up to " + std::to_string(action.times) + " times";
  if (action.tolerance > 0)
    text += "; " + std::string(word_of(action.norm)) + " " + formatted("%.0e", action.tolerance);
  return text + (action.tolerance > 0 ? ", at most " : "; at most ") +
         std::to_string(action.max_iterations) + " iterations";
}

nlohmann::ordered_json to_json(const CvtAction& action) {
  return {{"kind", word_of(action.kind)},  {"cells", action.cells},
          {"times", action.times},         {"norm", word_of(action.norm)},
          {"tolerance", action.tolerance}, {"max_iterations", action.max_iterations}};
}

} // namespace calotte::tools
