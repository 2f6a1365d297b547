// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "content.h"
#include "module.h"
#include "runs.h"
#include "words.h"

#include <calotte/mesh_file.h>
#include <calotte/refine.h>
#include <calotte/rotate.h>

#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace calotte::python {
namespace {

/// refine() or coarsen().
using Change = ChangedMesh(const Mesh&, const WidthDemand&, const RefineOptions&);

py::list patches_of(const ChangedMesh& changed) {
  py::list patches;
  for (const ChangedPatch& patch : changed.patches) {
    py::dict values;
    values["removed"] = patch.removed;
    values["added"] = patch.added;
    values["converged"] = patch.report.converged;
    values["well_centred"] = patch.report.well_centred;
    values["cells_beyond_limits"] = patch.report.cells_beyond_limits;
    values["residual"] = patch.report.residual;
    values["iterations"] = patch.report.iterations.size();
    values["seconds"] = patch.report.seconds;
    patches.append(values);
  }
  return patches;
}

/// The file that a mesh is of. Without rings and periods, a plane is known by what its cells fill.
MeshFile file_of(const MeshFile& content, const py::object& mesh) {
  MeshFile file = whole(content, mesh);
  if (file.plane() && !file.mesh->surface.is_bounded() && file.mesh->surface.period().isZero(0))
    if (const std::optional<Surface> filled = filled_surface(file))
      file.mesh->surface = *filled;
  return file;
}

/// Runs a change of a mesh, and takes along what its file holds.
/// \param content of the file that the mesh is of, or None.
/// \returns the new mesh, its content or None, and the rest by name.
py::tuple run(Change* change, const py::object& mesh, const py::object& content,
              const WidthDemand& demand, RefineOptions options, const FieldMethods& methods,
              py::object progress) {
  options.progress = callback_of(std::move(progress), ProgressReply::cancel);
  std::optional<MeshFile> file;
  if (!content.is_none())
    file = file_of(content.cast<const MeshFile&>(), mesh);
  const Mesh& old = file ? *file->mesh : mesh.cast<const Mesh&>();
  ChangedFile out;
  ChangedMesh changed = call([&] {
    ChangedMesh made = change(old, demand, options);
    if (file)
      out = changed_file(*file, made, methods);
    return made;
  });
  py::dict values;
  values["patches"] = patches_of(changed);
  values["held"] = changed.held;
  values["missed"] = changed.missed;
  values["new_of_old"] = handed_over(std::move(changed.new_of_old));
  values["old_of_new"] = handed_over(std::move(changed.old_of_new));
  values["width_ratio"] = handed_over(std::move(changed.width_ratio));
  values["nearest"] = out.nearest;
  values["left_out"] = out.left_out;
  if (!file)
    return py::make_tuple(std::make_shared<Mesh>(std::move(changed.mesh)), py::none(), values);
  const py::tuple parts = parts_of(std::move(out.file));
  return py::make_tuple(parts[0], parts[1], values);
}

/// A function of Python for one of the two.
auto runner(Change* change) {
  return [change](const py::object& mesh, const py::object& content, const WidthDemand& demand,
                  const RefineOptions& options, const FieldMethods& methods, py::object progress) {
    return run(change, mesh, content, demand, options, methods, std::move(progress));
  };
}

/// Rotates a mesh or polygons, and what their file holds.
/// \param content of the file that the grid is of, or None.
/// \returns the grid, its content or None, and the names of fields that could not turn.
py::tuple rotate_grid(const py::object& grid, const py::object& content,
                      const Eigen::Vector2d& from, const Eigen::Vector2d& to, double bearing) {
  const MeshFile file = file_of_cells(content, grid);
  RotatedFile out = call([&] { return rotated(file, Rotation(from, to, bearing)); });
  const py::tuple parts = parts_of(std::move(out.file));
  return py::make_tuple(parts[0], content.is_none() ? py::object(py::none()) : parts[1],
                        out.fields.unturned);
}

} // namespace

void add_changes(py::module_& module) {
  module.def("radius_of_widths", [](std::optional<double> planet_km, double sphere_radius) {
    return radius_of_widths(planet_km, sphere_radius);
  });
  py::class_<WidthDemand>(module, "WidthDemand")
      .def(py::init<>())
      .def_readwrite("widths", &WidthDemand::widths)
      .def_readwrite("region", &WidthDemand::region)
      .def_readwrite("factor", &WidthDemand::factor)
      .def_readwrite("radius_km", &WidthDemand::radius_km);
  py::class_<RefineOptions> options(module, "RefineOptions");
  options.def(py::init<>())
      .def_readwrite("tolerance", &RefineOptions::tolerance)
      .def_readwrite("gradient", &RefineOptions::gradient)
      .def_property(
          "regions", [](const RefineOptions& options) { return options.decomposition.regions; },
          [](RefineOptions& options, std::optional<int> regions) {
            options.decomposition.regions = regions;
          });
  add_word(
      options, "boundary", "boundary", boundary_words(),
      [](auto& of) -> auto& { return of.boundary; });
  py::class_<FieldMethods>(module, "FieldMethods")
      .def(py::init<>())
      .def_readwrite("nearest", &FieldMethods::nearest)
      .def_readwrite("conservative", &FieldMethods::conservative);
  module.def("refine", runner(&refine));
  module.def("coarsen", runner(&coarsen));
  module.def("rotate", [](const py::object& grid, const py::object& content,
                          const std::array<double, 2>& from, const std::array<double, 2>& to,
                          double bearing) {
    return rotate_grid(grid, content, {from[0], from[1]}, {to[0], to[1]}, bearing);
  });
}

} // namespace calotte::python
