// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "content.h"
#include "members.h"
#include "module.h"

#include "draw/coastlines.h"

#include <calotte/cut.h>
#include <calotte/error.h>
#include <calotte/field_grid.h>
#include <calotte/generators.h>
#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/partition.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>
#include <calotte/write_grid.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

struct Output {
  std::string path, history;
  Format format = Format::by_name;
  std::optional<double> radius; ///< default: that of a file that was read, or 1
  Density density;
  bool known = true; ///< whether the mesh was made for that density
  std::vector<MeshField> fields;
  Numbering numbering = Numbering::by_format;
  std::optional<std::string> model; ///< that reads the file
  std::optional<double> planet;     ///< its radius in km; default: the model's
  DoubleVector depth_levels;        ///< see WriteOptions; empty for none
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

/// Sets the layers of FESOM, whose depths are no field of its format.
/// \throws Error invalid_argument for layers in another format, and for one without the other.
void set_layers(const Output& output, WriteOptions& options) {
  const bool is_fesom = format_of(output.path, output.format) == Format::fesom,
             has_levels = output.depth_levels.size() > 0;
  if (has_levels && !is_fesom)
    throw Error(ErrorCode::invalid_argument,
                output.path + ": depth_levels applies to FESOM's nod2d.out; leave it out");
  if (!is_fesom)
    return;
  const auto depth = std::ranges::find_if(options.fields, [](const MeshField& field) {
    return field.name == "depth" && field.count() == 1;
  });
  const bool has_depth = depth != options.fields.end();
  if (has_levels && !has_depth)
    throw Error(ErrorCode::invalid_argument,
                output.path +
                    ": depth_levels needs depths; give the field depth, with a number for "
                    "each cell");
  if (has_depth && !has_levels)
    throw Error(ErrorCode::invalid_argument,
                output.path + ": FESOM's depths need layers; give depth_levels, too");
  if (!has_levels)
    return;
  options.depth_levels = output.depth_levels;
  options.site_depth = depth->values;
  options.fields.erase(depth);
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
  options.fields = output.fields;
  set_layers(output, options);
  return options;
}

bool is_mpas(Format format) { return format == Format::mpas || format == Format::mpas_minimal; }

/// What a written file lacks of a grid, or has otherwise.
struct Written {
  std::vector<std::string> dropped; ///< names of fields of a file that the format does not hold
  EarReport ears;                   ///< of FESOM
  CoastChanges coast;               ///< of cells of a region of the sphere
};

py::dict values_of(const Written& written) {
  py::dict values;
  values["dropped"] = written.dropped;
  values["ears"] = py::make_tuple(written.ears.triangles, written.ears.sites);
  values["hidden"] = py::make_tuple(written.coast.hidden_cells, written.coast.hidden_cell);
  values["small"] = py::make_tuple(written.coast.small_cells, written.coast.small_cell);
  return values;
}

/// Makes an open mesh one that FESOM reads; depths follow.
EarReport remove_ears(MeshFile& file, WriteOptions& options) {
  const bool has_depth = options.site_depth.size() > 0;
  if (has_depth)
    file.fields.push_back({.name = "depth", .values = std::move(options.site_depth)});
  WithoutEars rest = without_ears(std::move(file));
  file = std::move(rest.file);
  if (has_depth) {
    options.site_depth = std::move(file.fields.back().values);
    file.fields.pop_back();
  }
  return rest.removed;
}

Written write_file(MeshFile file, const Output& output, WriteOptions options) {
  const Format format = format_of(output.path, output.format);
  const bool lacks_density =
      file.density.size() == 0 || file.density.minCoeff() == file.density.maxCoeff();
  if (!output.known && lacks_density && is_mpas(format))
    options.site_density = spacing_density(file);
  Written written;
  if (const Mesh* mesh = file.sphere(); format == Format::fesom && mesh && !mesh->closed())
    written.ears = remove_ears(file, options);
  written.dropped = write(output.path, file, options).dropped;
  return written;
}

Written write_mesh_of(const Mesh& mesh, const Output& output) {
  WriteOptions options = options_of(output);
  const Format format = format_of(output.path, output.format);
  const bool is_part = mesh.surface.is_sphere() && !mesh.closed();
  if (is_part && format == Format::fesom) {
    MeshFile file;
    file.mesh = mesh;
    return write_file(std::move(file), output, options);
  }
  if (is_part && mesh.surface.is_bounded()) {
    Schedule whole; // of no run
    whole.recipe.surface = mesh.surface;
    whole.density = options.density;
    return {{}, {}, write_grid(output.path, mesh, whole.recipe, whole, options).coast};
  }
  if (!output.known && mesh.surface.is_sphere() && mesh.closed() && is_mpas(format))
    options.site_density = spacing_density(voronoi(mesh));
  write(output.path, mesh, options);
  return {};
}

py::dict write_mesh(const Mesh& mesh, const Output& output) {
  return values_of(call([&] { return write_mesh_of(mesh, output); }));
}

/// Writes what was read.
py::dict write_content(const MeshFile& content, const py::object& grid, const Output& output) {
  MeshFile file = whole(content, grid);
  WriteOptions options = options_of(output);
  if (!output.radius && !output.model)
    options.sphere_radius = file.radius_in_metres();
  if (!output.model)
    options.vertex_order = file.vertex_order;
  return values_of(call([&] { return write_file(std::move(file), output, std::move(options)); }));
}

/// \param content of the file that the grid is of, or None. \param weights none for equal cells.
py::array partition_cells(const py::object& content, const py::object& grid, std::int64_t parts,
                          const Doubles& weights) {
  const MeshFile file = file_of_cells(content, grid);
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
  options.coast = without_small(read_coasts(land.land), land.least_area, earth_radius_km);
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
  options.sea_ice_latitude = words["sea_ice_latitude"].cast<std::optional<double>>();
  options.land_path = words["land_mesh"].cast<std::string>();
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
  values["locked"] = report.sea.locked;
  values["others"] = report.others;
  values["severed"] = report.sea.severed;
  py::list parts;
  for (std::size_t k = 0; k < report.sea.severed_parts.size(); ++k) {
    const Points2 at = to_lonlat(report.severed.col(static_cast<Eigen::Index>(k)));
    parts.append(py::make_tuple(report.sea.severed_parts[k].cells, at(0, 0), at(1, 0)));
  }
  values["severed_parts"] = parts;
  values["stranded_passages"] = report.stranded_passages;
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
                 Density density, bool known, const std::vector<FieldState>& fields,
                 std::string history, const std::optional<std::string>& order,
                 std::optional<std::string> model, std::optional<double> planet,
                 const DoubleVector& depth_levels) {
  return {std::move(path),      std::move(history),
          format_named(format), radius,
          std::move(density),   known,
          fields_from(fields),  order ? numbering_named(*order) : Numbering::by_format,
          std::move(model),     planet,
          depth_levels};
}

} // namespace

void add_files(py::module_& module) {
  py::class_<Output>(module, "Output").def(py::init(&output_of));
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
