// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/renumber.h>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>

namespace calotte::python {
namespace {

/// What Mesh and PlanarMesh have in common.
template <class AnyMesh> auto add_mesh(py::module_& module, const char* name) {
  return py::class_<AnyMesh, std::shared_ptr<AnyMesh>>(module, name)
      .def_property_readonly(
          "points", [](py::object self) { return view(self.cast<const AnyMesh&>().points, self); })
      .def_property_readonly(
          "triangles",
          [](py::object self) { return view(self.cast<const AnyMesh&>().triangles, self); })
      .def_property_readonly(
          "neighbours",
          [](py::object self) { return view(self.cast<const AnyMesh&>().neighbours, self); })
      .def_property_readonly(
          "site_of_input",
          [](py::object self) { return view(self.cast<const AnyMesh&>().site_of_input, self); })
      .def("__len__", [](const AnyMesh& mesh) { return mesh.points.cols(); });
}

DelaunayOptions options_of(double merge_within, bool merge, std::optional<int> regions) {
  DelaunayOptions options;
  options.merge_within = merge_within;
  options.duplicates = merge ? Duplicates::merge : Duplicates::refuse;
  options.partition.regions = regions;
  options.progress = [](const Progress&) { // ^C reaches the thread that Python's main code runs in
    const py::gil_scoped_acquire locked;
    check_interrupt();
    return false;
  };
  return options;
}

std::shared_ptr<Mesh> delaunay(const Doubles& points, double merge_within, bool merge,
                               std::optional<int> regions) {
  const DelaunayOptions options = options_of(merge_within, merge, regions);
  const auto sites = columns(points);
  return call([&] { return std::make_shared<Mesh>(spherical_delaunay(sites, options)); });
}

std::shared_ptr<PlanarMesh> delaunay_in_plane(const Doubles& points,
                                              std::optional<Eigen::Vector2d> period,
                                              double merge_within, bool merge,
                                              std::optional<int> regions) {
  const DelaunayOptions options = options_of(merge_within, merge, regions);
  const auto sites = columns(points);
  return call([&] {
    return std::make_shared<PlanarMesh>(period ? periodic_delaunay(sites, *period, options)
                                               : planar_delaunay(sites, options));
  });
}

template <class AnyMesh> Check check_of(const AnyMesh& mesh) {
  return call([&] { return check(mesh); });
}

Numbering numbering_of(const std::string& name) {
  return name == "curve" ? Numbering::curve : name == "rcm" ? Numbering::rcm : Numbering::input;
}

} // namespace

void add_meshes(py::module_& module) {
  add_mesh<Mesh>(module, "Mesh")
      .def_property_readonly("closed", &Mesh::closed)
      .def("renumbered",
           [](const Mesh& mesh, const std::string& numbering) {
             return call(
                 [&] { return std::make_shared<Mesh>(renumbered(mesh, numbering_of(numbering))); });
           })
      .def("bisected_points",
           [](const Mesh& mesh) { return handed_over(call([&] { return bisect(mesh); })); });
  add_mesh<PlanarMesh>(module, "PlanarMesh").def_property_readonly("period", [](py::object self) {
    return view(self.cast<const PlanarMesh&>().period, self);
  });
  module.def("delaunay", &delaunay);
  module.def("delaunay_in_plane", &delaunay_in_plane);
  py::class_<Check>(module, "Check")
      .def_readonly("failure", &Check::failure)
      .def_readonly("sites", &Check::sites)
      .def_readonly("triangles", &Check::triangles)
      .def_readonly("boundary_edges", &Check::boundary_edges)
      .def_readonly("area", &Check::area)
      .def_property_readonly("passed", &Check::passed)
      .def("__bool__", &Check::passed);
  module.def("check", &check_of<Mesh>);
  module.def("check", &check_of<PlanarMesh>);
}

} // namespace calotte::python
