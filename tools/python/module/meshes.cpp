// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "members.h"
#include "module.h"
#include "planes.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/region.h>
#include <calotte/renumber.h>

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

/// What Mesh and PlanarMesh have in common. An instance has a dictionary, for what a file holds
/// besides the mesh.
template <class AnyMesh>
auto add_mesh(py::module_& module, const char* name, const char* doc, const char* points) {
  auto type = py::class_<AnyMesh, std::shared_ptr<AnyMesh>>(module, name, doc, py::dynamic_attr());
  add_member(type, Member{"points", &AnyMesh::points, points});
  add_member(type, Member{"triangles", &AnyMesh::triangles,
                          "(m, 3) ids of sites, counter-clockwise, seen from outside a sphere."});
  add_member(type, Member{"neighbours", &AnyMesh::neighbours,
                          "(m, 3) the triangle across from each vertex; -1 at an open boundary."});
  add_member(type, Member{"site_of_input", &AnyMesh::site_of_input,
                          "For each point of the input its site."});
  type.def("__len__", [](const AnyMesh& mesh) { return mesh.points.cols(); });
  return type;
}

template <class AnyMesh> py::tuple state_of(const py::object& self) {
  const auto& mesh = self.cast<const AnyMesh&>();
  const py::object rest = self.attr("__dict__");
  if constexpr (std::is_same_v<AnyMesh, PlanarMesh>)
    return py::make_tuple(mesh.points, mesh.triangles, mesh.neighbours, mesh.site_of_input,
                          py::make_tuple(mesh.period, rest));
  else
    return py::make_tuple(mesh.points, mesh.triangles, mesh.neighbours, mesh.site_of_input, rest,
                          mesh.surface.rings());
}

template <class AnyMesh> std::shared_ptr<AnyMesh> of_state(const py::tuple& state) {
  auto mesh = std::make_shared<AnyMesh>();
  mesh->points = state[0].cast<decltype(mesh->points)>();
  mesh->triangles = state[1].cast<Triangles>();
  mesh->neighbours = state[2].cast<Triangles>();
  mesh->site_of_input = state[3].cast<std::vector<std::int32_t>>();
  return mesh;
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
  return call([&] { return std::make_shared<Mesh>(calotte::delaunay(sites, {}, options)); });
}

std::shared_ptr<PlanarMesh> delaunay_in_plane(const Doubles& points,
                                              std::optional<Eigen::Vector2d> period,
                                              double merge_within, bool merge,
                                              std::optional<int> regions) {
  const DelaunayOptions options = options_of(merge_within, merge, regions);
  const auto sites = columns(points);
  return call([&] {
    const Surface surface = period ? Surface::periodic(*period) : Surface::plane();
    return std::make_shared<PlanarMesh>(planar(calotte::delaunay(sites, surface, options)));
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
  auto sphere = add_mesh<Mesh>(
      module, "Mesh", "A Delaunay triangulation of the sphere, of delaunay(), cvt() or read().",
      "(n, 3) sites: directions, of a CVT or a file unit vectors.");
  sphere.def_property_readonly("closed", &Mesh::closed, "True if the triangles cover the sphere.")
      .def(
          "renumbered",
          [](const Mesh& mesh, const std::string& numbering) {
            return call(
                [&] { return std::make_shared<Mesh>(renumbered(mesh, numbering_of(numbering))); });
          },
          "The same mesh with its sites along a curve (\"curve\"), or so that neighbours have "
          "near\n"
          "numbers (\"rcm\": reverse Cuthill-McKee).")
      .def(
          "bisected_points",
          [](const Mesh& mesh) { return handed_over(call([&] { return bisect(mesh); })); },
          "(4 n - 6, 3) the points and the midpoints of the edges.")
      .def(py::pickle(&state_of<Mesh>, [](const py::tuple& state) {
        auto mesh = of_state<Mesh>(state);
        mesh->surface = Region(state[5].cast<std::vector<Points3>>());
        return std::pair(std::move(mesh), state[4].cast<py::dict>());
      }));
  auto plane = add_mesh<PlanarMesh>(
      module, "PlanarMesh",
      "A Delaunay triangulation of the plane or of a periodic box, of delaunay(), cvt() or read().",
      "(n, 2) sites, in any unit of length.");
  add_member(plane,
             Member{"period", &PlanarMesh::period,
                    "(2,) side lengths of the periodic box, unit of the points; 0 if none."});
  plane.def(py::pickle(&state_of<PlanarMesh>, [](const py::tuple& state) {
    auto mesh = of_state<PlanarMesh>(state);
    const auto rest = state[4].cast<py::tuple>();
    mesh->period = rest[0].cast<Eigen::Vector2d>();
    return std::pair(std::move(mesh), rest[1].cast<py::dict>());
  }));
  module.def("delaunay", &delaunay);
  module.def("delaunay_in_plane", &delaunay_in_plane);
  py::class_<Check> check(module, "Check", "What check() found; true if all laws hold.");
  add_members(check,
              Member{"failure", &Check::failure, "The first law that does not hold, or empty."},
              Member{"sites", &Check::sites, "Number of points."},
              Member{"triangles", &Check::triangles, "Number of triangles."},
              Member{"boundary_edges", &Check::boundary_edges, "Number of edges of one triangle."},
              Member{"area", &Check::area,
                     "Sum of the triangles' areas; steradians, in the plane the square of the "
                     "points' unit."});
  check.def_property_readonly("passed", &Check::passed, "True if all laws hold.")
      .def("__bool__", &Check::passed);
  module.def("check", &check_of<Mesh>);
  module.def("check", &check_of<PlanarMesh>);
}

} // namespace calotte::python
