// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_actions.h"

#include "text/text.h"

#include <calotte/grid.h>

namespace calotte::tools {

std::string described(const CvtAction& action) {
  return message("{} cells{}; {}at most {} iterations", action.cells,
                 action.times > 1 ? message(", up to {} times", action.times) : "",
                 action.tolerance > 0
                     ? message("{} {}, ", word_of(action.norm), formatted("%.0e", action.tolerance))
                     : "",
                 action.max_iterations);
}

nlohmann::ordered_json to_json(const CvtAction& action) {
  return {{"kind", word_of(action.kind)},  {"cells", action.cells},
          {"times", action.times},         {"norm", word_of(action.norm)},
          {"tolerance", action.tolerance}, {"max_iterations", action.max_iterations}};
}

} // namespace calotte::tools
