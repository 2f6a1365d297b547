// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"

#include <calotte/domain.h>
#include <calotte/ocean.h>
#include <calotte/read.h>
#include <calotte/region.h>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

std::vector<Points3> rings_of(const std::vector<Doubles>& arrays) {
  std::vector<Points3> rings;
  for (const Doubles& array : arrays)
    rings.emplace_back(columns(array));
  return rings;
}

template <class Rings> py::list arrays_of(const Rings& rings, py::handle owner) {
  py::list arrays;
  for (const auto& ring : rings)
    arrays.append(view(ring, owner));
  return arrays;
}

/// What rings enclose, or the side of them that contains a place.
Region polygon(const std::vector<Doubles>& rings, const std::optional<Eigen::Vector3d>& inside) {
  return call([&] {
    return inside ? region_around(rings_of(rings), *inside) : enclosed_region(rings_of(rings));
  });
}

/// A ring may repeat its first corner at its end.
PlanarDomain domain_of(const std::vector<Doubles>& arrays) {
  PlanarDomain domain;
  for (const Doubles& array : arrays) {
    DoubleMatrix ring = columns(array);
    const Eigen::Index last = ring.cols() - 1;
    if (last > 0 && ring.col(last) == ring.col(0))
      ring.conservativeResize(Eigen::NoChange, last);
    domain.rings.push_back(std::move(ring));
  }
  require_domain(domain);
  return domain;
}

template <class Part, class Place>
py::array_t<bool> contains_all(const Part& part, const Doubles& points) {
  py::array_t<bool> inside(points.shape(0));
  bool* out = inside.mutable_data();
  const auto places = columns(points);
  call([&] {
    const auto holds = containing(part);
    for (Eigen::Index i = 0; i < places.cols(); ++i)
      out[i] = holds(Place(places.col(i)));
  });
  return inside;
}

} // namespace

void add_regions(py::module_& module) {
  py::class_<Region>(module, "Region",
                     "A part of the sphere, of circle(), ellipse(), channel(), polygon() or a "
                     "file.")
      .def(py::init<>())
      .def(py::init([](const std::vector<Doubles>& rings) {
        Region region{rings_of(rings)};
        require_region(region);
        return region;
      }))
      .def_property_readonly(
          "rings",
          [](py::object self) { return arrays_of(self.cast<const Region&>().rings, self); },
          "List of the boundary's rings, each (k, 3) unit vectors, the region to the left.")
      .def_property_readonly("whole", &Region::whole, "True if it is the whole sphere.")
      .def_property_readonly(
          "area", [](const Region& region) { return area(region); }, "Its area, steradians.")
      .def("contains", &contains_all<Region, Eigen::Vector3d>,
           "(n,) for each of n x 3 directions whether it lies in the region.")
      .def("widened", &widened, "The region and what is within a distance of it, radians.")
      .def(py::pickle(
          [](const Region& region) { return py::make_tuple(region.rings); },
          [](const py::tuple& state) { return Region{state[0].cast<std::vector<Points3>>()}; }));
  module.def("polygon", &polygon);
  module.def("circle", &circle);
  module.def("ellipse", &ellipse);
  module.def("channel", &channel);
  module.def("read_region", [](const std::string& path) { return Region(read_region(path)); });
  module.def("land_around", [](const std::string& path, const Eigen::Vector3d& place) {
    return Region(call([&] { return land_around(read_coast(path), place); }));
  });
  py::class_<PlanarDomain>(module, "PlanarDomain",
                           "A part of the plane, of rectangle(), periodic_box(), planar_polygon() "
                           "or a file.")
      .def(py::init(&domain_of))
      .def_property_readonly(
          "rings",
          [](py::object self) { return arrays_of(self.cast<const PlanarDomain&>().rings, self); },
          "List of the boundary's rings, each (k, 2) in the unit of the points.")
      .def_property_readonly(
          "period",
          [](py::object self) { return view(self.cast<const PlanarDomain&>().period, self); },
          "(2,) side lengths of a periodic box; 0 elsewhere.")
      .def_property_readonly(
          "area", [](const PlanarDomain& domain) { return area(domain); },
          "Its area, in the square of the unit of the points.")
      .def("contains", &contains_all<PlanarDomain, Eigen::Vector2d>,
           "(n,) for each of n x 2 points whether it lies in the domain.")
      .def(py::pickle(
          [](const PlanarDomain& domain) { return py::make_tuple(domain.rings, domain.period); },
          [](const py::tuple& state) {
            return PlanarDomain(state[0].cast<decltype(PlanarDomain::rings)>(),
                                state[1].cast<Eigen::Vector2d>());
          }));
  module.def("rectangle", &rectangle);
  module.def("periodic_box", &periodic_box);
  module.def("read_domain",
             [](const std::string& path) { return PlanarDomain(read_domain(path)); });
}

} // namespace calotte::python
