// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/density_option.h"
#include "options/domain_option.h"
#include "options/files.h"
#include "options/mesh_source.h"
#include "options/model_option.h"
#include "options/numbers.h"
#include "options/sphere_radius_option.h"
#include "options/units_option.h"
#include "run/mesh_measures.h"
#include "run/model_gates.h"
#include "run/progress.h"
#include "text/text.h"
#include "view/view_mesh.h"

#include <calotte/check.h>
#include <calotte/error.h>
#include <calotte/field_grid.h>
#include <calotte/limited_area.h>
#include <calotte/mesh_file.h>
#include <calotte/quality.h>

#include <CLI/App.hpp>

#include <iostream>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

struct InfoRequest {
  std::shared_ptr<MeshSource> source;
  std::shared_ptr<DensityWords> density;
  std::shared_ptr<DomainWords> domain; ///< of a mesh of the plane
  std::optional<double> sphere_radius; ///< metres
  std::optional<std::string> units;    ///< --units
  std::optional<std::int64_t> cell;    ///< whose numbers are asked for
  std::optional<std::string> model;    ///< --for
  bool operators = false;              ///< whether the errors of operators are
  std::string report;
};

/// The report replaces no input.
void require_report(const InfoRequest& request) {
  const WidthWords& widths = request.density->widths;
  require_outputs({{"report", request.report}},
                  {request.source->path, request.source->points, request.source->mesh, widths.file,
                   widths.raster, request.domain->file.value_or("")});
}

std::optional<double> radius_of(const InfoRequest& request, const MeshFile& file) {
  return radius_km(file, request.density->widths, request.sphere_radius);
}

/// The density that is given, or else that of the file.
Density density_or_file_density(const InfoRequest& request, const MeshFile& file,
                                Measured& measured) {
  const Density given = density_of(*request.density, file.mesh->surface);
  measured.density = density_name(*request.density);
  if (!given.uniform() || file.density.size() == 0 || !file.sphere() ||
      file.density.minCoeff() == file.density.maxCoeff())
    return given;
  measured.density = "of the file";
  measured.remarks.emplace_back("the density is the file's, interpolated between the sites");
  return interpolated_density(*file.mesh, file.density);
}

/// Finds the boundary and whether a mesh has Voronoi cells; remarks tell why cells are left out.
void find_boundary(const EdgeCounts& edges, Measured& measured) {
  measured.cells = edges.not_delaunay == 0;
  if (edges.boundary > 0) {
    measured.open = edges;
    measured.remarks.push_back(message(
        "the mesh is open: {} boundary edges in {}; its triangles {} measured", edges.boundary,
        counted(edges.loops, "loop"), measured.cells ? "and whole cells are" : "are"));
  }
  if (edges.not_delaunay > 0)
    measured.remarks.push_back(
        message("{} edges are not Delaunay; the triangles are measured", edges.not_delaunay));
}

/// The cells by bdyMaskCell; none if the file does not have it.
std::vector<std::int64_t> masks_of(const std::string& path, std::int64_t cells) {
  std::vector<std::int64_t> counts;
  for (const std::int32_t mask : cell_mask_of(path, cells)) {
    counts.resize(limited_area_rings + 1);
    ++counts[static_cast<std::size_t>(mask)];
  }
  return counts;
}

constexpr const char* no_operators =
    "operators need Voronoi cells, so their errors are not measured";

void measure_sphere(const InfoRequest& request, const MeshFile& file, Measured& measured) {
  const Mesh& mesh = *file.mesh;
  measured.radius_km = radius_of(request, file);
  measured.unit = unit_of(request.units, measured.radius_km);
  find_boundary(count_edges(mesh), measured);
  if (measured.open && is_netcdf(file))
    measured.masks = masks_of(request.source->path, mesh.points.cols());
  if (measured.open && file.polygons) {
    measured.areas = shapes(*file.polygons).area;
    measured.cells_area = areas(*file.polygons).sum() / (4 * std::numbers::pi);
  }
  const Density density = measured.cells && !measured.open
                              ? density_or_file_density(request, file, measured)
                              : Density{};
  measured.quality = !measured.cells ? triangle_quality(mesh)
                     : measured.open ? open_quality(mesh)
                                     : quality(mesh, density);
  if (measured.quality.flat > 0)
    measured.remarks.push_back(
        message("{} triangles along the boundary are flatter than rounding and are not measured",
                measured.quality.flat));
  if (request.operators && measured.cells)
    measured.operators = operator_errors(mesh, density);
  else if (request.operators)
    measured.remarks.emplace_back(no_operators);
}

/// A plane with walls, such as a channel: as an open mesh of the sphere. The file's cells have the
/// area.
void measure_walls(const InfoRequest& request, const MeshFile& file, Measured& measured) {
  find_boundary(count_edges(*file.mesh), measured);
  measured.quality = open_quality(*file.mesh);
  measured.domain_area = areas(*file.polygons).sum();
  if (request.operators)
    measured.remarks.emplace_back("the operators of a plane with walls are not measured");
}

void measure_plane(const InfoRequest& request, const MeshFile& file,
                   const std::optional<Surface>& covered, Measured& measured) {
  if (!covered && file.polygons && file.mesh->surface.period().maxCoeff() > 0)
    return measure_walls(request, file, measured);
  if (!covered)
    refuse_path(request.source->path, "a planar mesh needs its domain, which clips the cells; "
                                      "give --domain, --rectangle or --periodic");
  measured.density = density_name(*request.density);
  const Density density = density_of(*request.density, *covered);
  Mesh mesh = *file.mesh;
  mesh.surface = *covered;
  measured.quality = quality(mesh, density);
  if (request.operators)
    measured.operators = operator_errors(mesh, density);
  measured.domain_area = covered->area();
}

/// Whether the file's cells are measured by their corners alone: those of the sphere that are no
/// Voronoi cells, and those of a plane whose domain nothing tells.
bool as_polygons(const InfoRequest& request, const MeshFile& file,
                 const std::optional<Surface>& covered) {
  if (!file.polygons)
    return false;
  if (file.plane())
    return !request.operators && file.mesh->surface.period().maxCoeff() == 0 && !covered;
  return file.other_cells() != nullptr;
}

std::string remarks_of(const InfoRequest& request, const Measured& measured) {
  std::string lines;
  for (const auto* list : {&measured.changes, &measured.remarks})
    for (const std::string& remark : *list)
      lines += message("{}: {}\n", request.source->path, remark);
  return lines;
}

/// The numbers of one cell, a line each. Writes the report, too.
std::string cell_table(const InfoRequest& request, const MeshFile& file, Progress& progress) {
  const ViewMesh mesh = view_mesh(request.source->path, file,
                                  {.density = density_of(*request.density, file.mesh->surface),
                                   .radius_km = radius_of(request, file),
                                   .units = request.units,
                                   .operators = request.operators,
                                   .most_cells = std::numeric_limits<std::int64_t>::max()});
  std::string lines = cell_table(mesh, *request.cell);
  if (!request.report.empty()) {
    progress.writing(request.report);
    write_file(request.report, cell_report(mesh, *request.cell));
  }
  return lines;
}

/// The fields at cells: those with one number for each at the indices of --at, and the others.
FieldGrid fields_of(const MeshSource& source) {
  if (!source.mesh.empty())
    return read_field_grid(source.path, source.mesh, FieldChoice::scalars, source.at);
  FieldGrid grid;
  MeshFile file = read_mesh_file(source, FieldChoice::all);
  for (MeshField& field : file.fields)
    if (field.location == FieldLocation::cells)
      (field.count() > 1 ? grid.not_scalars : grid.fields).push_back(std::move(field));
  return grid;
}

std::string range_of(const MeshField& field) {
  const Quantity quantity = quantity_of(field);
  const auto text = [](const std::optional<double>& value) {
    return value ? value_text(*value, "") : "no value";
  };
  return message("{} to {}, mean {}{}{}", text(quantity.least), text(quantity.greatest),
                 text(quantity.mean), quantity.unit.empty() ? "" : " " + quantity.unit,
                 quantity.missing > 0 ? message(", {} missing", quantity.missing) : "");
}

/// The dimensions of which --at has no index yet: "Time (4), nVertLevels (3); see --at".
std::string dimensions_of(const MeshField& field, const std::vector<FieldIndex>& at) {
  const auto indices = find_indices(field.dimensions, at);
  std::vector<std::string> names;
  for (std::size_t d = 0; d < indices.size(); ++d)
    if (const FieldDimension& dimension = field.dimensions[d]; !indices[d] && dimension.size > 1)
      names.push_back(message("{} ({})", dimension.name, dimension.size));
  return listed(names) + "; see --at";
}

/// Refuses the options of measures. \throws Error invalid_argument.
void require_fields_alone(const InfoRequest& request) {
  const std::vector<std::pair<const char*, bool>> of_measures{
      {"--report", !request.report.empty()},
      {"--operators", request.operators},
      {"--for", request.model.has_value()},
      {"--units", request.units.has_value()},
      {"--sphere-radius", request.sphere_radius.has_value()},
      {"--density", !request.density->densities.empty()},
      {"--cell-width", request.density->widths.given()},
      {"--domain, --rectangle and --periodic", request.domain->given()}};
  std::vector<std::string> given;
  for (const auto& [option, is_given] : of_measures)
    if (is_given)
      given.emplace_back(option);
  if (!given.empty())
    refuse(message("--mesh and --at print fields, not measures; leave out {}", listed(given)));
}

/// The fields at cells, a line each: their ranges, or the dimensions that have several numbers.
std::string field_table(const InfoRequest& request) {
  const MeshSource& source = *request.source;
  require_fields_alone(request);
  constexpr std::size_t column = 26;
  const FieldGrid grid = fields_of(source);
  std::string lines = source.at.empty() ? "" : row("indices", column, words_of(source.at));
  for (const MeshField& field : grid.fields)
    lines += row(field.name, column, range_of(field));
  for (const MeshField& field : grid.not_scalars)
    lines += row(field.name, column, dimensions_of(field, source.at));
  return lines.empty() ? message("{}: no fields at cells\n", source.path) : lines;
}

/// The table to print. Writes the report, too.
std::string read_and_measure(const InfoRequest& request) {
  Progress progress;
  progress.stage("reading " + request.source->path);
  if (!request.cell && !(request.source->mesh.empty() && request.source->at.empty()))
    return field_table(request);
  MeshFile file =
      read_mesh_file(*request.source, request.cell ? FieldChoice::scalars : FieldChoice::none);
  request.density->widths.plane = file.plane() != nullptr;
  if (const std::optional<Surface> part = surface_of(*request.domain))
    set_surface(*file.mesh, *part);
  progress.stage("measuring " + request.source->path);
  if (request.cell)
    return cell_table(request, file, progress);
  Measured measured;
  measured.changes = file.changes;
  const std::optional<Surface> covered = filled_surface(file);
  const bool by_corners = as_polygons(request, file, covered);
  if (by_corners && file.plane()) {
    measured.remarks.emplace_back("the cells are measured as the file has them; give --domain for "
                                  "the measures of a CVT");
    measured.unit = {"", 1, "", 1};
  } else if (by_corners) {
    measured.remarks.push_back("the cells are not Voronoi cells: " + file.not_voronoi.text());
    if (request.operators)
      measured.remarks.emplace_back(no_operators);
    measured.radius_km = radius_of(request, file);
    measured.unit = unit_of(request.units, measured.radius_km);
  } else if (file.plane())
    measure_plane(request, file, covered, measured);
  else
    measure_sphere(request, file, measured);
  if (const std::string given = density_name(*request.density), none = Measured().density;
      given != none && measured.density == none)
    measured.remarks.push_back(message("the density {} is not used: closed meshes and domains of a "
                                       "plane are compared with one",
                                       given));
  if (const ModelNeeds* model = model_of(request.model)) {
    if (measured.cells && has_demanded_cells(file))
      measured.gates = gates_of(*model, request.source->path, file);
    else
      measured.remarks.push_back(no_demanded_cells(*model));
  }
  if (!request.report.empty()) {
    progress.writing(request.report);
    write_file(request.report,
               by_corners ? to_json(*file.polygons, file.mesh, measured) : to_json(measured));
  }
  return remarks_of(request, measured) +
         (by_corners ? table(*file.polygons, file.mesh, measured.unit) : table(measured));
}

void run(const InfoRequest& request) {
  require_sphere_radius(request.sphere_radius.value_or(1));
  require_report(request);
  std::cout << read_and_measure(request);
}

} // namespace

void add_info(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "info",
      "Measures a mesh: spacing, quality of cells and triangles, and distance from a CVT. calotte "
      "help measures explains the words.");
  auto request = std::make_shared<InfoRequest>();
  request->source = add_mesh_source(*command);
  add_fields_of(*command, *request->source);
  request->domain = add_domain(*command);
  request->density = add_density(*command);
  add_sphere_radius(*command, request->sphere_radius,
                    "Radius of the sphere, for distances in km: metres, > 0, or earth (6371229 m); "
                    "default: the planet's that the file names, or --earth-radius with "
                    "--cell-width");
  add_units(*command, request->units);
  add_demanding_model(*command, request->model);
  add_plane(*command, *request->source, {"--sphere-radius", "--units", "--for"}, domain_names);
  command
      ->add_option("--cell", request->cell,
                   "Print the numbers of one cell instead, by its place in the file, from 0")
      ->transform(whole_number(0, std::numeric_limits<std::int32_t>::max()));
  command->add_flag("--operators", request->operators,
                    "Also print the errors that the operators of a C-grid model (TRiSK) have on "
                    "the mesh for smooth fields, and the longest stable steps");
  command->add_option("--report", request->report, "Write the same quantities to this JSON file")
      ->type_name("FILE");
  set_help(
      *command,
      {.common = {"MESH", "--mesh", "--at", "--points", "--domain", "--density", "--cell-width",
                  "--sphere-radius", "--units", "--cell", "--operators", "--for", "--report"},
       .examples = {"calotte info mesh.nc", "calotte info mesh.nc --operators",
                    "calotte info mesh.nc --for mpas-ocean",
                    "calotte info history.nc --mesh mesh.nc --at time=3,lev=0",
                    "calotte info mesh.vtp --sphere-radius earth --cell-width 60km"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
