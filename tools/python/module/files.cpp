// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"

#include <calotte/cull.h>
#include <calotte/cut.h>
#include <calotte/error.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

/// The mesh of a file, and its scalar fields at cells by name.
py::tuple read(const std::string& path) {
  MeshFile file = call([&] { return read_mesh_file(path, nullptr, FieldChoice::scalars); });
  py::dict fields;
  for (MeshField& field : file.fields)
    if (field.location == Location::cells && field.count() == 1)
      fields[py::str(field.name)] = handed_over(std::move(field.values));
  if (file.mesh)
    return py::make_tuple(std::make_shared<Mesh>(std::move(*file.mesh)), fields);
  if (file.plane)
    return py::make_tuple(std::make_shared<PlanarMesh>(std::move(*file.plane)), fields);
  throw Error(ErrorCode::bad_option,
              path + ": holds polygons that are not Voronoi cells: " + file.not_voronoi);
}

struct Output {
  std::string path, history;
  Format format = Format::by_name;
  double radius = 1;
  Density density;
  bool known = true; ///< whether the mesh was made for that density
  py::dict fields;
};

WriteOptions options_of(const Output& output) {
  WriteOptions options;
  options.format = output.format;
  options.sphere_radius = output.radius;
  options.density = output.density;
  options.history = output.history;
  for (const auto& [name, values] : output.fields) {
    const auto numbers = values.cast<Doubles>();
    options.fields.push_back(
        {.name = name.cast<std::string>(),
         .values = Eigen::Map<const Eigen::VectorXd>(numbers.data(), numbers.size())});
  }
  return options;
}

void write_mesh(const Mesh& mesh, const Output& output) {
  WriteOptions options = options_of(output);
  call([&] {
    const Format format = format_of(output.path, output.format);
    if (!output.known && mesh.closed() &&
        (format == Format::mpas || format == Format::mpas_minimal))
      options.site_density = spacing_density(voronoi(mesh));
    write(output.path, mesh, options);
  });
}

void write_plane(const PlanarMesh& mesh, std::optional<PlanarDomain> domain, const Output& output) {
  WriteOptions options = options_of(output);
  call([&] {
    if (domain && !output.density.uniform()) {
      options.site_density = evaluate(output.density, *domain, mesh.points);
      options.density = {};
    }
    if (domain)
      write(output.path, mesh, *domain, options);
    else
      write(output.path, mesh, options);
  });
}

py::dict cut_mesh(const std::string& source, const std::string& target, const Region& region,
                  int rings, std::optional<double> radius) {
  CutOptions options;
  options.rings = rings;
  options.sphere_radius = radius;
  const CutReport report = call([&] { return cut(source, target, region, options); });
  py::dict values;
  values["cells"] = report.cells;
  values["cells_by_mask"] = report.cells_by_mask;
  values["left_out"] = report.left_out;
  return values;
}

py::dict write_limited(const Output& output, const Doubles& generators, const Region& meshed,
                       const Region& region) {
  CutOptions options;
  options.sphere_radius = output.radius;
  const WriteOptions written = options_of(output);
  const Points3 points = columns(generators);
  const CutReport report = call(
      [&] { return write_limited_area(output.path, points, meshed, region, written, options); });
  py::dict values;
  values["cells"] = report.cells;
  values["cells_by_mask"] = report.cells_by_mask;
  return values;
}

py::dict cull_mesh(const std::string& source, const std::string& target,
                   const std::optional<std::string>& coast, double land_fraction,
                   const std::optional<std::string>& passages,
                   const std::optional<std::string>& barriers, bool fill, const Doubles& seeds) {
  CullOptions options;
  options.land_fraction = land_fraction;
  options.fill = fill;
  options.seeds = columns(seeds);
  const CullReport report = call([&] {
    if (coast)
      options.coast = read_coast(*coast);
    if (passages)
      options.passages = read_lines(*passages);
    if (barriers)
      options.barriers = read_lines(*barriers);
    return cull(source, target, options);
  });
  py::dict values;
  values["cells"] = report.cells;
  values["land"] = report.land;
  values["filled"] = report.sea.filled;
  values["severed"] = report.sea.severed;
  return values;
}

Format format_named(const std::string& name) {
  if (name == "by-name")
    return Format::by_name;
  std::string names = "by-name";
  for (const auto& [word, format] : format_words()) {
    if (name == word)
      return format;
    names += ", " + word;
  }
  throw Error(ErrorCode::bad_option, "no format " + name + "; give one of: " + names);
}

Output output_of(std::string path, const std::string& format, double radius, Density density,
                 bool known, py::dict fields, std::string history) {
  return {std::move(path), std::move(history), format_named(format), radius, std::move(density),
          known,           std::move(fields)};
}

} // namespace

void add_files(py::module_& module) {
  py::class_<Output>(module, "Output").def(py::init(&output_of));
  module.def("read", &read);
  module.def("read_points", [](const std::string& path) {
    return handed_over(call([&] { return read_sites(path); }));
  });
  module.def("write", &write_mesh);
  module.def("write_in_plane", &write_plane);
  module.def("cut", &cut_mesh);
  module.def("write_limited_area", &write_limited);
  module.def("cull", &cull_mesh);
}

} // namespace calotte::python
