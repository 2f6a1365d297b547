// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"

#include <calotte/read.h>
#include <calotte/surface.h>

#include <pybind11/eigen.h>
#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

/// What rings enclose, or the side of them that contains a place.
Surface polygon(const std::vector<Doubles>& arrays, const std::optional<Eigen::Vector3d>& inside) {
  std::vector<Points3> rings;
  for (const Doubles& array : arrays)
    rings.emplace_back(columns(array));
  return call(
      [&]() -> Surface { return inside ? region_around(rings, *inside) : enclosed_region(rings); });
}

/// A ring may repeat its first corner at its end.
Surface planar_polygon(const std::vector<Doubles>& arrays) {
  Surface::Rings rings;
  for (const Doubles& array : arrays) {
    DoubleMatrix ring = columns(array);
    const Eigen::Index last = ring.cols() - 1;
    if (last > 0 && ring.col(last) == ring.col(0))
      ring.conservativeResize(Eigen::NoChange, last);
    rings.push_back(std::move(ring));
  }
  return Surface::plane().within(std::move(rings));
}

py::list rings_of(const py::object& self) {
  py::list arrays;
  for (const DoubleMatrix& ring : self.cast<const Surface&>().rings())
    arrays.append(view(ring, self));
  return arrays;
}

/// \param points n x 3; in the plane n x 2.
py::array_t<bool> contains(const Surface& surface, const Doubles& points) {
  py::array_t<bool> inside(points.shape(0));
  bool* out = inside.mutable_data();
  const auto given = columns(points);
  call([&] {
    Eigen::Vector3d point(0, 0, 0);
    for (Eigen::Index i = 0; i < given.cols(); ++i) {
      point.head(given.rows()) = given.col(i);
      out[i] = surface.contains(point);
    }
  });
  return inside;
}

py::tuple state_of_surface(const Surface& surface) {
  return py::make_tuple(surface.is_sphere(), surface.period(), surface.rings());
}

Surface surface_of_state(const py::tuple& state) {
  const auto period = state[1].cast<Eigen::Vector2d>();
  auto rings = state[2].cast<Surface::Rings>();
  const Surface whole = state[0].cast<bool>() ? Surface::sphere()
                        : period.isZero(0)    ? Surface::plane()
                                              : Surface::periodic(period);
  return rings.empty() ? whole : whole.within(std::move(rings));
}

} // namespace

void add_surfaces(py::module_& module) {
  py::class_<Surface>(module, "Surface",
                      "Where points live: the sphere, a plane, or a part of them, of circle(),\n"
                      "ellipse(), box(), channel(), polygon(), rectangle(), periodic_box(),\n"
                      "planar_polygon(), generalised_sea() or a file. Surface() is the sphere.")
      .def(py::init<>())
      .def_property_readonly(
          "rings", &rings_of,
          "List of the boundary's rings, each (k, 3) unit vectors, the surface to the left; in a "
          "plane (k, 2) in the unit of the points.")
      .def_property_readonly(
          "period",
          [](const py::object& self) { return view(self.cast<const Surface&>().period(), self); },
          "(2,) side lengths of a periodic plane; 0 in other directions.")
      .def_property_readonly("area", &Surface::area,
                             "Steradians, in a plane the square of the unit of the points; "
                             "infinite for a plane without an end.")
      .def_property_readonly("is_sphere", &Surface::is_sphere, "False in a plane.")
      .def_property_readonly("is_bounded", &Surface::is_bounded, "True if it has rings.")
      .def("widened", &widened,
           "A region of the sphere and what is within a distance of it, radians.")
      .def(py::self == py::self)
      .def(py::pickle(&state_of_surface, &surface_of_state));
  module.def("contains", &contains);
  module.def("plane", &Surface::plane);
  module.def("periodic_box", &Surface::periodic);
  module.def("planar_polygon", &planar_polygon);
  module.def("rectangle", &rectangle);
  module.def("polygon", &polygon);
  module.def("circle", &circle);
  module.def("ellipse", &ellipse);
  module.def("box", &box);
  module.def("channel", &channel);
  module.def("read_region", [](const std::string& word, double radius_km) {
    return call([&] { return read_region(word, radius_km); });
  });
  module.def("read_domain", &read_domain);
}

} // namespace calotte::python
