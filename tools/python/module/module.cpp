// SPDX-License-Identifier: GPL-3.0-or-later
#include "module.h"

#include "calls.h"

#include <calotte/version.h>

namespace calotte::python {

int& threads() {
  thread_local int count = 0;
  return count;
}

} // namespace calotte::python

PYBIND11_MODULE(_calotte, module) {
  using namespace calotte::python;
  module.doc() = "The compiled part of calotte.";
  module.attr("__version__") = CALOTTE_VERSION;
  module.def("set_threads", [](int count) { return std::exchange(threads(), count); });
  add_errors(module);
  add_surfaces(module);
  add_densities(module);
  add_widths(module);
  add_meshes(module);
  add_cells(module);
  add_operators(module);
  add_corners(module);
  add_points(module);
  add_positions(module);
  add_tessellations(module);
  add_multimeshes(module);
  add_contents(module);
  add_files(module);
  add_oceans(module);
  add_changes(module);
  add_field_grids(module);
}
