// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "content.h"
#include "members.h"
#include "module.h"

#include "draw/coastlines.h"

#include <calotte/cut.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/partition.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

FieldChoice choice_of(const std::string& fields) {
  return fields == "none"  ? FieldChoice::none
         : fields == "all" ? FieldChoice::all
                           : FieldChoice::scalars;
}

py::tuple read(const std::string& path, const std::string& fields) {
  return parts_of(call([&] { return read_mesh_file(path, nullptr, choice_of(fields)); }));
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
  using Dimensions = std::vector<std::tuple<std::string, std::int64_t, bool>>;
  for (const auto& [name, size, unlimited] : state[5].cast<Dimensions>())
    field.dimensions.push_back({name, size, unlimited});
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

struct Output {
  std::string path, history;
  Format format = Format::by_name;
  std::optional<double> radius; ///< default: that of a file that was read, or 1
  Density density;
  bool known = true; ///< whether the mesh was made for that density
  py::dict fields;
  Numbering numbering = Numbering::by_format;
  std::optional<std::string> model; ///< that reads the file
  std::optional<double> planet;     ///< its radius in km; default: the model's
};

/// Sets what a model expects of its files. \param format of the file. \param radius stays, if it is
/// given. \returns the model.
/// \throws Error invalid_argument for a word of no model, and for a format or a radius that it
///         cannot use.
template <class Options>
const ModelNeeds& set_model(const std::string& word, Format format, std::optional<double> radius,
                            Options& options) {
  const ModelNeeds* const model = find_model(word);
  if (model == nullptr) {
    std::string words;
    for (const ModelNeeds& known : models())
      words += (words.empty() ? "" : ", ") + known.word;
    throw Error(ErrorCode::invalid_argument, "no model " + word + "; give one of: " + words);
  }
  if (model->format != format)
    throw Error(ErrorCode::invalid_argument,
                "model " + word + " reads the format " + info_of(model->format).word + ", not " +
                    info_of(format).word + "; give a file of that format, or leave the model out");
  options.sphere_radius = radius.value_or(model->sphere_radius);
  options.vertex_order = model->vertex_order;
  options.dimensions = model->dimensions;
  if (radius && !suits(*model, model->format, *radius, model->vertex_order, model->dimensions))
    throw Error(ErrorCode::invalid_argument,
                "model " + word +
                    " needs a sphere with another radius than sphere_radius; leave "
                    "one of them out");
  return *model;
}

WriteOptions options_of(const Output& output) {
  WriteOptions options;
  options.format = output.format;
  options.numbering = output.numbering;
  options.sphere_radius = output.radius.value_or(1);
  if (output.model) {
    const ModelNeeds& model =
        set_model(*output.model, format_of(output.path, output.format), output.radius, options);
    if (output.numbering == Numbering::by_format)
      options.numbering = model.numbering;
    options.planet_radius = model.planet_radius;
  }
  if (output.planet)
    options.planet_radius = 1000 * *output.planet;
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

bool is_mpas(Format format) { return format == Format::mpas || format == Format::mpas_minimal; }

void write_mesh(const Mesh& mesh, const Output& output) {
  WriteOptions options = options_of(output);
  call([&] {
    const Format format = format_of(output.path, output.format);
    if (!output.known && mesh.surface.is_sphere() && mesh.closed() && is_mpas(format))
      options.site_density = spacing_density(voronoi(mesh));
    write(output.path, mesh, options);
  });
}

/// Writes what was read. \returns the names of the fields that the format does not hold.
std::vector<std::string> write_content(const MeshFile& content, const py::object& grid,
                                       const Output& output) {
  const MeshFile file = whole(content, grid);
  WriteOptions options = options_of(output);
  if (!output.radius && !output.model)
    options.sphere_radius = file.radius_in_metres();
  if (!output.model)
    options.vertex_order = file.vertex_order;
  return call([&] {
    const bool lacks_density =
        file.density.size() == 0 || file.density.minCoeff() == file.density.maxCoeff();
    if (!output.known && lacks_density && is_mpas(format_of(output.path, output.format)))
      options.site_density = spacing_density(file);
    return write(output.path, file, options).dropped;
  });
}

/// \param content of the file that the grid is of, or None. \param weights none for equal cells.
py::array partition_cells(const py::object& content, const py::object& grid, std::int64_t parts,
                          const Doubles& weights) {
  MeshFile file =
      content.is_none() ? whole({}, grid) : whole(content.cast<const MeshFile&>(), grid);
  if (py::isinstance<Polygons>(grid))
    file.polygons = grid.cast<const Polygons&>();
  PartitionOptions options;
  options.weights = Eigen::Map<const DoubleVector>(weights.data(), weights.size());
  return handed_over(call([&] { return partition(cell_neighbours(file), parts, options).part; }));
}

py::dict cut_mesh(const std::string& source, const std::string& target, const Surface& region,
                  int rings, std::optional<double> radius,
                  const std::optional<std::string>& model) {
  CutOptions options;
  options.rings = rings;
  options.sphere_radius = radius;
  if (model)
    set_model(*model, Format::mpas, radius, options);
  else if (!radius)
    options.vertex_order.reset(); // the source's, too
  const CutReport report = call([&] { return cut(source, target, region, options); });
  py::dict values;
  values["cells"] = report.cells;
  values["cells_by_mask"] = report.cells_by_mask;
  values["left_out"] = report.left_out;
  return values;
}

/// \param mesh of a run of a limited area.
py::dict write_limited(const Output& output, const Mesh& mesh, const Surface& region) {
  const CutReport report =
      call([&] { return write_limited_area(output.path, mesh, region, options_of(output)); });
  py::dict values;
  values["cells"] = report.cells;
  values["cells_by_mask"] = report.cells_by_mask;
  return values;
}

/// Longitudes and latitudes, degrees, of each line.
py::list coast_lines() {
  py::list lines;
  for (const auto& line : tools::coastlines()) {
    Points2 places(2, std::ssize(line));
    for (std::size_t k = 0; k < line.size(); ++k)
      places.col(static_cast<Eigen::Index>(k)) << line[k].longitude, line[k].latitude;
    lines.append(handed_over(std::move(places)));
  }
  return lines;
}

/// The boundaries of land of a file, unit vectors.
py::list coast_rings(const std::string& path) {
  Coast coast = call([&] { return read_coast(path); });
  py::list rings;
  for (Points3& ring : coast.rings)
    rings.append(handed_over(std::move(ring)));
  return rings;
}

RasterQuantity values_named(const std::string& name) {
  return name == "height"         ? RasterQuantity::height
         : name == "sea-fraction" ? RasterQuantity::sea_fraction
                                  : RasterQuantity::land_fraction;
}

/// The land of an ocean grid, as the options of `calotte cull` name it.
struct Land {
  std::vector<std::string> land, passages, barriers; ///< files
  std::string raster, raster_variable, raster_values;
  std::string field, field_file;
  std::optional<double> sea_from, sea_below;
  double land_fraction = 0.5;
  double least_area = 0; ///< km^2 of the Earth
};

Land land_of(const py::dict& words) {
  return {.land = words["land"].cast<std::vector<std::string>>(),
          .passages = words["passages"].cast<std::vector<std::string>>(),
          .barriers = words["barriers"].cast<std::vector<std::string>>(),
          .raster = words["raster"].cast<std::string>(),
          .raster_variable = words["raster_variable"].cast<std::string>(),
          .raster_values = words["raster_values"].cast<std::string>(),
          .field = words["field"].cast<std::string>(),
          .field_file = words["field_file"].cast<std::string>(),
          .sea_from = words["sea_from"].cast<std::optional<double>>(),
          .sea_below = words["sea_below"].cast<std::optional<double>>(),
          .land_fraction = words["land_fraction"].cast<double>(),
          .least_area = words["least_area"].cast<double>()};
}

void set_land(const Land& land, CullOptions& options) {
  for (const std::string& file : land.land) {
    const Coast coast = read_coast(file);
    options.coast.area += coast.area;
    options.coast.rings.insert(options.coast.rings.end(), coast.rings.begin(), coast.rings.end());
  }
  options.coast =
      without_small(options.coast, land.least_area / (earth_radius_km * earth_radius_km));
  const auto add_lines = [](const std::vector<std::string>& files, std::vector<Points3>& lines) {
    for (const std::string& file : files)
      for (Points3& line : read_lines(file))
        lines.push_back(std::move(line));
  };
  add_lines(land.passages, options.passages);
  add_lines(land.barriers, options.barriers);
  if (!land.raster.empty())
    options.raster = read_land(land.raster, land.raster_variable, values_named(land.raster_values));
  options.land_fraction = land.land_fraction;
  options.field.path = land.field_file;
  options.field.variable = land.field;
  if (land.sea_from)
    options.field.lower = *land.sea_from;
  if (land.sea_from || land.sea_below)
    options.field.upper = land.sea_below.value_or(std::numeric_limits<double>::infinity());
}

py::dict cull_mesh(const std::string& source, const std::string& target, const py::dict& words,
                   bool fill, const Doubles& seeds, const std::string& mask,
                   const std::string& cell_map, std::optional<double> radius,
                   const std::optional<std::string>& model) {
  const Land land = land_of(words);
  CullOptions options;
  options.fill = fill;
  options.seeds = columns(seeds);
  options.mask_path = mask;
  options.cell_map_folder = cell_map;
  options.sphere_radius = radius;
  if (model)
    set_model(*model, Format::mpas, radius, options);
  const CullReport report = call([&] {
    set_land(land, options);
    return cull(source, target, options);
  });
  py::dict values;
  values["cells"] = report.cells;
  values["land"] = report.land;
  values["filled"] = report.sea.filled;
  values["severed"] = report.sea.severed;
  py::list parts;
  for (std::size_t k = 0; k < report.sea.severed_parts.size(); ++k) {
    const Points2 at = to_lonlat(report.severed.col(static_cast<Eigen::Index>(k)));
    parts.append(py::make_tuple(report.sea.severed_parts[k].cells, at(0, 0), at(1, 0)));
  }
  values["severed_parts"] = parts;
  return values;
}

Format format_named(const std::string& name) {
  if (name == "by-name")
    return Format::by_name;
  std::string names = "by-name";
  for (const FormatInfo& info : formats()) {
    if (info.word.empty())
      continue;
    if (name == info.word)
      return info.format;
    names += ", " + info.word;
  }
  throw Error(ErrorCode::invalid_argument, "no format " + name + "; give one of: " + names);
}

Output output_of(std::string path, const std::string& format, std::optional<double> radius,
                 Density density, bool known, py::dict fields, std::string history,
                 const std::optional<std::string>& order, std::optional<std::string> model,
                 std::optional<double> planet) {
  return {std::move(path),      std::move(history),
          format_named(format), radius,
          std::move(density),   known,
          std::move(fields),    order ? numbering_named(*order) : Numbering::by_format,
          std::move(model),     planet};
}

} // namespace

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

void add_files(py::module_& module) {
  py::class_<Output>(module, "Output").def(py::init(&output_of));
  add_shapes(module);
  add_content(module);
  module.def("read", &read);
  module.def("cells_of_file", &cells_of);
  module.def("write_content", &write_content);
  module.def("read_points", [](const std::string& path) {
    return handed_over(call([&] { return read_sites(path); }));
  });
  module.def("write", &write_mesh);
  module.def("partition", &partition_cells);
  module.def("cut", &cut_mesh);
  module.def("write_limited_area", &write_limited);
  module.def("cull", &cull_mesh);
  module.def("coastlines", &coast_lines);
  module.def("coast_rings", &coast_rings);
}

} // namespace calotte::python
