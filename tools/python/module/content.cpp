// SPDX-License-Identifier: GPL-3.0-or-later
#include "content.h"

#include "calls.h"
#include "members.h"
#include "module.h"

#include <calotte/error.h>
#include <calotte/field_grid.h>
#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

FieldChoice choice_of(const std::string& fields) {
  return fields == "none"  ? FieldChoice::none
         : fields == "all" ? FieldChoice::all
                           : FieldChoice::scalars;
}

/// Pairs of a dimension and an index.
using Choices = std::vector<std::pair<std::string, std::int64_t>>;

std::vector<FieldIndex> indices_of(const Choices& choices) {
  std::vector<FieldIndex> indices;
  for (const auto& [dimension, index] : choices)
    indices.push_back({dimension, index});
  return indices;
}

/// \param mesh the file of the mesh, if that is not `path`; or "".
MeshFile read_file(const std::string& path, FieldChoice choice, const std::string& mesh,
                   const std::vector<FieldIndex>& at) {
  if (mesh.empty())
    return read_mesh_file(path, nullptr, choice, at);
  FieldGrid grid = read_field_grid(path, mesh, choice, at);
  MeshFile file = std::move(grid.mesh);
  file.fields = std::move(grid.fields);
  return file;
}

py::tuple read(const std::string& path, const std::string& fields, const std::string& mesh,
               const Choices& at) {
  return parts_of(call([&] { return read_file(path, choice_of(fields), mesh, indices_of(at)); }));
}

std::vector<FieldDimension> dimensions_of(const Dimensions& state) {
  std::vector<FieldDimension> dimensions;
  for (const auto& [name, size, unlimited] : state)
    dimensions.push_back({name, size, unlimited});
  return dimensions;
}

/// Names of the dimensions of the fields at cells, besides that of the cells, by name of the field.
py::dict dimensions_of_fields(const MeshFile& content) {
  py::dict names;
  for (const MeshField& field : content.fields) {
    py::list list;
    for (const FieldDimension& dimension : field.dimensions)
      list.append(dimension.name);
    if (field.location == FieldLocation::cells)
      names[py::str(field.name)] = py::tuple(list);
  }
  return names;
}

/// The polygons of a content, which keeps their memory; none where a mesh has the cells.
std::shared_ptr<Polygons> polygons_of(const Content& content) {
  return content->polygons ? std::shared_ptr<Polygons>(content, &*content->polygons) : nullptr;
}

/// The numbers at cells by name: n, or n x the sizes of a field's other dimensions.
py::dict fields_of(py::object self) {
  const auto& content = self.cast<const MeshFile&>();
  py::dict fields;
  for (const MeshField& field : content.fields) {
    if (field.location != FieldLocation::cells)
      continue;
    std::vector<py::ssize_t> shape{field.values.size() / field.count()};
    for (const FieldDimension& dimension : field.dimensions)
      shape.push_back(dimension.size);
    py::array_t<double> values(shape, field.values.data(), self);
    values.attr("setflags")(py::arg("write") = false);
    fields[py::str(field.name)] = values;
  }
  return fields;
}

std::shared_ptr<Voronoi> cells_of(const MeshFile& content, const py::object& grid) {
  const MeshFile file = whole(content, grid);
  return call([&] { return std::make_shared<Voronoi>(voronoi(file)); });
}

py::tuple state_of_answer(const NotVoronoi& answer) {
  return py::make_tuple(static_cast<int>(answer.fault), answer.cells, answer.polygons,
                        answer.centres, answer.distance, answer.detail);
}

NotVoronoi answer_of(const py::tuple& state) {
  return {.fault = static_cast<CellFault>(state[0].cast<int>()),
          .cells = state[1].cast<std::array<std::int64_t, 3>>(),
          .polygons = state[2].cast<std::int64_t>(),
          .centres = state[3].cast<std::int64_t>(),
          .distance = state[4].cast<double>(),
          .detail = state[5].cast<std::string>()};
}

py::tuple state_of_content(const MeshFile& content) {
  py::list fields;
  for (const MeshField& field : content.fields) {
    py::list dimensions;
    for (const FieldDimension& dimension : field.dimensions)
      dimensions.append(py::make_tuple(dimension.name, dimension.size, dimension.unlimited));
    fields.append(py::make_tuple(
        field.name, field.long_name, field.units, static_cast<int>(field.location), field.values,
        dimensions, field.leading, field.integer, field.single, field.directed, field.attributes));
  }
  return py::make_tuple(content.format, polygons_of(std::make_shared<MeshFile>(content)),
                        state_of_answer(content.not_voronoi), content.sphere_radius,
                        content.density, fields, static_cast<int>(content.vertex_order),
                        content.planet_radius);
}

MeshField field_of(const py::tuple& state) {
  MeshField field{.name = state[0].cast<std::string>(),
                  .long_name = state[1].cast<std::string>(),
                  .units = state[2].cast<std::string>(),
                  .location = static_cast<FieldLocation>(state[3].cast<int>()),
                  .values = state[4].cast<Eigen::VectorXd>(),
                  .leading = state[6].cast<int>(),
                  .integer = state[7].cast<bool>(),
                  .single = state[8].cast<bool>(),
                  .directed = state[9].cast<bool>(),
                  .attributes = state[10].cast<std::vector<std::array<std::string, 2>>>()};
  field.dimensions = dimensions_of(state[5].cast<Dimensions>());
  return field;
}

Content content_of_state(const py::tuple& state) {
  auto content = std::make_shared<MeshFile>();
  content->format = state[0].cast<std::string>();
  if (!state[1].is_none())
    content->polygons = state[1].cast<const Polygons&>();
  content->not_voronoi = answer_of(state[2].cast<py::tuple>());
  content->sphere_radius = state[3].cast<double>();
  content->density = state[4].cast<Eigen::VectorXd>();
  for (const py::handle field : state[5])
    content->fields.push_back(field_of(py::reinterpret_borrow<py::tuple>(field)));
  content->vertex_order = static_cast<VertexOrder>(state[6].cast<int>());
  content->planet_radius = state[7].cast<std::optional<double>>();
  return content;
}

using Begin = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
using CornerIds = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;

/// Cells on the sphere. \throws Error invalid_argument for ids out of range.
std::shared_ptr<Polygons> polygons_from(const Doubles& corners, const Begin& begin,
                                        const CornerIds& ids) {
  auto cells = std::make_shared<Polygons>();
  cells->corners = columns(corners);
  cells->ids = {Eigen::Map<const Offsets>(begin.data(), begin.size()),
                Eigen::Map<const Ids>(ids.data(), ids.size())};
  const auto& [starts, items] = cells->ids;
  const bool ascending = starts.size() > 0 && starts[0] == 0 &&
                         starts[cells->size()] == items.size() &&
                         std::is_sorted(starts.begin(), starts.end());
  if (corners.ndim() != 2 || corners.shape(1) != 3 || !ascending ||
      (items.size() > 0 && (items.minCoeff() < 0 || items.maxCoeff() >= corners.shape(0))))
    throw Error(ErrorCode::invalid_argument,
                "corners, begin and ids do not fit; give m x 3 corners, and ids below m of which "
                "begin[i] to begin[i + 1] - 1 are those of polygon i");
  return cells;
}

void add_shapes(py::module_& module) {
  py::class_<PolygonShapes> shapes(
      module, "PolygonShapes", "What polygons measure, of Polygons.shapes().", py::dynamic_attr());
  add_members(
      shapes,
      Member{"area", &PolygonShapes::area,
             "Range of the areas; steradians, in a plane the square of its unit."},
      Member{"spacing", &PolygonShapes::spacing,
             "Range of the distances between centres of polygons that share a side; radians, in a "
             "plane its unit; 0 without centres."},
      Member{"without_area", &PolygonShapes::without_area, "Number of polygons without area."},
      Member{"first_without_area", &PolygonShapes::first_without_area, "The first; -1 for none."},
      Member{"not_convex", &PolygonShapes::not_convex,
             "Number of polygons that turn to the right at a corner."},
      Member{"first_not_convex", &PolygonShapes::first_not_convex, "The first; -1 for none."},
      Member{"not_centroidal", &PolygonShapes::not_centroidal,
             "Number of polygons whose centre is not their centroid, by 1e-6 widths."},
      Member{"off_centring", &PolygonShapes::off_centring, "The largest distance, in widths."},
      Member{"worst_centred", &PolygonShapes::worst_centred, "Its polygon; -1 without centres."});
}

void add_content(py::module_& module) {
  py::class_<Polygons, std::shared_ptr<Polygons>> polygons(
      module, "Polygons",
      "Cells of a file that are not the Voronoi cells of a whole mesh: those of a part of the\n"
      "sphere, such as an ocean, of a bounded plane, or cells of any shape. Their sides are arcs\n"
      "of great circles, in a plane straight.",
      py::dynamic_attr());
  polygons.def(py::init(&polygons_from), py::arg("corners"), py::arg("begin"), py::arg("ids"));
  add_member(polygons, Member{"corners", &Polygons::corners,
                              "(m, 3) unit vectors; in a plane in its unit, z = 0."});
  add_member(polygons, Member{"ids", &Polygons::ids, "Ids of corners; see begin.",
                              "(n + 1,) polygon i has the corners ids[begin[i]] to "
                              "ids[begin[i + 1] - 1], counter-clockwise."});
  add_member(polygons, Member{"centres", &Polygons::centres,
                              "(n, 3) as the corners; (0, 3) if the file gives none."});
  add_member(polygons, Member{"surface", &Polygons::surface, "The Surface that they live on."});
  polygons.def("__len__", &Polygons::size)
      .def_property_readonly(
          "areas",
          [](const Polygons& cells) { return handed_over(call([&] { return areas(cells); })); },
          "(n,) their areas; steradians, in a plane the square of its unit.")
      .def(
          "shapes", [](const Polygons& cells) { return call([&] { return shapes(cells); }); },
          "Measures of the polygons, see PolygonShapes.")
      .def(py::pickle(
          [](const py::object& self) {
            const auto& cells = self.cast<const Polygons&>();
            return py::make_tuple(cells.corners, cells.ids.begin, cells.ids.items, cells.centres,
                                  cells.surface, self.attr("__dict__"));
          },
          [](const py::tuple& state) {
            auto cells = std::make_shared<Polygons>();
            cells->corners = state[0].cast<Points3>();
            cells->ids = {state[1].cast<Offsets>(), state[2].cast<Ids>()};
            cells->centres = state[3].cast<Points3>();
            cells->surface = state[4].cast<Surface>();
            return std::pair(std::move(cells), state[5].cast<py::dict>());
          }));
  py::class_<MeshFile, Content>(module, "Content")
      .def_property_readonly("polygons", &polygons_of)
      .def_property_readonly("fields", &fields_of)
      .def_property_readonly("dimensions", &dimensions_of_fields)
      .def_readonly("format", &MeshFile::format)
      .def_property_readonly("not_voronoi",
                             [](const MeshFile& file) { return file.not_voronoi.text(); })
      .def_readonly("sphere_radius", &MeshFile::sphere_radius)
      .def_readonly("planet_radius", &MeshFile::planet_radius)
      .def_readonly("changes", &MeshFile::changes)
      .def_property_readonly(
          "density",
          [](py::object self) { return view(self.cast<const MeshFile&>().density, self); })
      .def(py::pickle(&state_of_content, &content_of_state));
}

/// The neighbours of the cells of a file, or of the sites of a mesh.
IdLists neighbours_of(const py::object& content, const py::object& grid) {
  const MeshFile file = file_of_cells(content, grid);
  return call([&] { return file.polygons ? cell_neighbours(file) : neighbours(*file.mesh); });
}

} // namespace

std::vector<MeshField> fields_from(const std::vector<FieldState>& states) {
  std::vector<MeshField> fields;
  for (const auto& [name, values, dimensions, leading, units, long_name, attributes] : states)
    fields.push_back({.name = name,
                      .long_name = long_name,
                      .units = units,
                      .values = Eigen::Map<const Eigen::VectorXd>(values.data(), values.size()),
                      .dimensions = dimensions_of(dimensions),
                      .leading = leading,
                      .attributes = attributes});
  return fields;
}

MeshFile file_of_cells(const py::object& content, const py::object& grid) {
  MeshFile file =
      content.is_none() ? whole({}, grid) : whole(content.cast<const MeshFile&>(), grid);
  if (py::isinstance<Polygons>(grid))
    file.polygons = grid.cast<const Polygons&>();
  return file;
}

py::tuple parts_of(MeshFile file) {
  auto content = std::make_shared<MeshFile>(std::move(file));
  py::object grid;
  if (content->mesh)
    grid = py::cast(std::make_shared<Mesh>(std::move(*content->mesh)));
  else
    grid = py::cast(std::shared_ptr<Polygons>(content, &*content->polygons));
  content->mesh.reset();
  return py::make_tuple(grid, content);
}

MeshFile whole(const MeshFile& content, const py::object& grid) {
  MeshFile file = content;
  if (py::isinstance<Mesh>(grid))
    file.mesh = grid.cast<const Mesh&>();
  return file;
}

void add_contents(py::module_& module) {
  add_shapes(module);
  add_content(module);
  module.def("read", &read);
  module.def("find_all_indices",
             [](const std::string& name, const Dimensions& dimensions, const Choices& at) {
               return find_all_indices(name, dimensions_of(dimensions), indices_of(at));
             });
  module.def("neighbours", &neighbours_of);
  module.def("cells_of_file", &cells_of);
}

} // namespace calotte::python
