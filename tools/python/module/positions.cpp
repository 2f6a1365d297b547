// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "members.h"
#include "module.h"
#include "words.h"

#include <calotte/area_weights.h>
#include <calotte/locate.h>
#include <calotte/remap.h>

#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace calotte::python {
namespace {

std::shared_ptr<Locations> locate_in(const Mesh& mesh, const Doubles& positions) {
  const auto places = columns(positions);
  return call([&] { return std::make_shared<Locations>(locate(mesh, places)); });
}

using IdsIn = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;

constexpr std::array<NamedValue<EdgeCells>, 4> edge_words{{{"whole", EdgeCells::whole},
                                                           {"hull", EdgeCells::hull},
                                                           {"neighbours", EdgeCells::neighbours},
                                                           {"reach", EdgeCells::reach}}};

py::array weights_of(const Doubles& points, const Surface& surface,
                     const std::optional<std::string>& edge, double reach, double gap,
                     double merge_within) {
  const auto places = columns(points);
  AreaWeightOptions options{.reach = reach, .gap = gap, .merge_within = merge_within};
  if (edge)
    options.edge = named(std::span<const NamedValue<EdgeCells>>(edge_words), *edge, "edge");
  return handed_over(call([&] { return area_weights(places, surface, options); }));
}

/// Numbers of Python, or none.
Ids ids_of(const IdsIn& given) { return Eigen::Map<const Ids>(given.data(), given.size()); }

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
  module.def("cells_at", [](const Polygons& cells, const Doubles& positions) {
    const auto places = columns(positions);
    return handed_over(call([&] { return cells_at(cells, places); }));
  });
  module.def("area_weights", &weights_of);
  py::class_<Locator>(module, "Locator")
      .def(py::init([](const Mesh& mesh) { return call([&] { return Locator(mesh); }); }),
           py::keep_alive<1, 2>())
      .def("find",
           [](const Locator& locator, const Doubles& positions, const IdsIn& hints) {
             const auto places = columns(positions);
             const Ids near = ids_of(hints);
             return call([&] { return std::make_shared<Locations>(locator.find(places, near)); });
           })
      .def("nearest",
           [](const Locator& locator, const Doubles& positions, const IdsIn& hints) {
             const auto places = columns(positions);
             const Ids near = ids_of(hints);
             return handed_over(call([&] { return locator.nearest(places, near); }));
           })
      .def("nearest_few",
           [](const Locator& locator, const Doubles& positions, std::int64_t k) {
             const auto places = columns(positions);
             return call([&] { return locator.nearest_few(places, k); });
           })
      .def("within", [](const Locator& locator, const Doubles& positions, double distance) {
        const auto places = columns(positions);
        return call([&] { return locator.within(places, distance); });
      });
}

} // namespace calotte::python
