// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "content.h"
#include "members.h"
#include "module.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

/// The mesh, with the dictionary of its instance, for what a file holds besides it.
py::tuple state_of_mesh(const py::object& self) {
  const auto& mesh = self.cast<const Mesh&>();
  return py::make_tuple(mesh.points, mesh.triangles, mesh.neighbours, mesh.site_of_input,
                        mesh.surface, self.attr("__dict__"));
}

std::pair<std::shared_ptr<Mesh>, py::dict> mesh_of_state(const py::tuple& state) {
  Mesh mesh{state[0].cast<Points3>(), state[1].cast<Triangles>(), state[2].cast<Triangles>(),
            state[3].cast<std::vector<std::int32_t>>(), state[4].cast<Surface>()};
  return {std::make_shared<Mesh>(std::move(mesh)), state[5].cast<py::dict>()};
}

DelaunayOptions options_of(double merge_within, bool merge, std::optional<int> regions) {
  DelaunayOptions options;
  options.merge_within = merge_within;
  options.duplicates = merge ? Duplicates::merge : Duplicates::refuse;
  options.decomposition.regions = regions;
  options.progress = [](const Progress&) { // ^C reaches the thread that Python's main code runs in
    const py::gil_scoped_acquire locked;
    check_interrupt();
    return ProgressReply::proceed;
  };
  return options;
}

std::shared_ptr<Mesh> delaunay(const Doubles& points, const Surface& surface, double merge_within,
                               bool merge, std::optional<int> regions) {
  const DelaunayOptions options = options_of(merge_within, merge, regions);
  const auto sites = columns(points);
  return call([&] { return std::make_shared<Mesh>(calotte::delaunay(sites, surface, options)); });
}

/// The mesh of a plane with the boundary of a surface.
/// \throws Error invalid_argument for a surface of another period.
std::shared_ptr<Mesh> within(const Mesh& mesh, const Surface& surface) {
  if (surface.period() != mesh.surface.period())
    throw Error(ErrorCode::invalid_argument,
                "the mesh and the surface have different periods; give the surface of the mesh");
  auto bounded = std::make_shared<Mesh>(mesh);
  bounded->surface = surface;
  return bounded;
}

} // namespace

Numbering numbering_named(const std::string& word) {
  if (word != "curve" && word != "input")
    throw Error(ErrorCode::invalid_argument, "no order " + word + "; give curve or input");
  return word == "curve" ? Numbering::curve : Numbering::input;
}

void add_meshes(py::module_& module) {
  py::class_<Mesh, std::shared_ptr<Mesh>> type(
      module, "Mesh",
      "A Delaunay triangulation of the sphere or of a plane, of delaunay(), cvt() or read().",
      py::dynamic_attr());
  type.def_property_readonly(
          "points",
          [](const py::object& self) {
            const auto& mesh = self.cast<const Mesh&>();
            const py::array all = view(mesh.points, self);
            return mesh.surface.is_sphere()
                       ? all
                       : py::array(all[py::make_tuple(py::ellipsis(), py::slice(0, 2, 1))]);
          },
          "(n, 3) sites: directions, of a CVT unit vectors, of a file as long as the file has "
          "them; in a plane (n, 2) in any "
          "unit of length.")
      .def_property_readonly(
          "surface", [](const Mesh& mesh) { return mesh.surface; },
          "The Surface that the points live on; in a plane its rings clip the cells.");
  add_member(type, Member{"triangles", &Mesh::triangles,
                          "(m, 3) ids of sites, counter-clockwise, seen from outside a sphere."});
  add_member(type,
             Member{"neighbours", &Mesh::neighbours,
                    "(m, 3) the triangle across from each vertex; -1 at an open boundary. Of sites "
                    "see the function neighbours()."});
  add_member(
      type, Member{"site_of_input", &Mesh::site_of_input, "For each point of the input its site."});
  type.def_property_readonly("closed", &Mesh::closed,
                             "True if the triangles cover the sphere, or a periodic box.")
      .def("__len__", [](const Mesh& mesh) { return mesh.points.cols(); })
      .def(
          "renumbered",
          [](const Mesh& mesh, const std::string& numbering) {
            return call([&] {
              return std::make_shared<Mesh>(renumbered(mesh, numbering_named(numbering)));
            });
          },
          "The same mesh with its sites along a curve (\"curve\").")
      .def(
          "bisected_points",
          [](const Mesh& mesh) {
            return handed_over_on(mesh.surface, call([&] { return bisect(mesh); }));
          },
          "The points and the midpoints of the edges, those inside of the surface.")
      .def(py::pickle(&state_of_mesh, &mesh_of_state));
  module.def("delaunay", &delaunay);
  module.def("within", &within);
  py::class_<CheckReport> check(module, "Check", "What check() found; true if all laws hold.");
  add_members(
      check,
      Member{"failure", &CheckReport::failure, "The first law that does not hold, or empty."},
      Member{"sites", &CheckReport::sites, "Number of points."},
      Member{"triangles", &CheckReport::triangles, "Number of triangles."},
      Member{"boundary_edges", &CheckReport::boundary_edges, "Number of edges of one triangle."},
      Member{"area", &CheckReport::area,
             "Sum of the triangles' areas; steradians, in the plane the square of the "
             "points' unit."});
  check.def_property_readonly("passed", &CheckReport::passed, "True if all laws hold.")
      .def("__bool__", &CheckReport::passed);
  module.def("check", [](const Mesh& mesh) { return call([&] { return calotte::check(mesh); }); });
}

} // namespace calotte::python
