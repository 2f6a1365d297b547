// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "members.h"
#include "module.h"

#include <calotte/locate.h>

#include <memory>
#include <utility>

namespace calotte::python {
namespace {

std::shared_ptr<Locations> locate_in(const Mesh& mesh, const Doubles& positions) {
  const auto places = columns(positions);
  return call([&] { return std::make_shared<Locations>(locate(mesh, places)); });
}

} // namespace

void add_positions(py::module_& module) {
  py::class_<Locations, std::shared_ptr<Locations>> type(
      module, "Locations", "Where positions lie in a mesh, of locate().");
  add_members(
      type,
      Member{"triangle", &Locations::triangle,
             "(k,) the triangle that holds the position, the lowest of several; -1 outside "
             "of an open mesh."},
      Member{"weights", &Locations::weights,
             "(k, 3) barycentric, of the triangle's vertices; their sum is 1; NaN outside."},
      Member{"nearest", &Locations::nearest,
             "(k,) the nearest site, the lowest of those that are equally near."});
  type.def("__len__", [](const Locations& locations) { return locations.triangle.size(); });
  module.def("locate", &locate_in);
}

} // namespace calotte::python
