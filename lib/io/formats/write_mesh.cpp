// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/write_mesh.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/cells/model_grid.h"
#include "io/cells/polygons.h"
#include "io/cells/written_fields.h"
#include "io/cells/written_values.h"
#include "io/command.h"
#include "io/formats/formats.h"

#include "base/monitor.h"
#include "base/points.h"
#include "domain/surface.h"
#include "mesh/ids.h"
#include "mesh/renumber.h"

#include <calotte/check.h>
#include <calotte/coastal_cells.h>
#include <calotte/mesh_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {

void require_options(const std::string& path, const WriteOptions& options) {
  if (!(options.sphere_radius > 0 && std::isfinite(options.sphere_radius)))
    refuse_path(path, "the sphere's radius is {}; give a positive number of metres",
                options.sphere_radius);
  if (const double planet = options.planet_radius.value_or(1);
      !(planet > 0 && std::isfinite(planet)))
    refuse_path(path, "the planet's radius is {}; give a positive number of metres", planet);
  evaluate(options.density, Points3(3, 0)); // throws where it is ill-formed
}

Numbering choose_numbering(const WriteOptions& options) {
  if (options.numbering != Numbering::by_format)
    return options.numbering;
  return info_of(options.format).netcdf ? Numbering::curve : Numbering::input;
}

bool is_coast_field(const MeshField& field, Format format) {
  const CoastParts& holds = find_row(format).holds;
  return field.location == FieldLocation::cells && field.count() == 1 &&
         ((holds.depth && field.name == depth_field) ||
          (holds.boundary && field.name == open_field));
}

void take_coast_fields(WriteOptions& options) {
  for (const MeshField& field : options.fields) {
    if (!is_coast_field(field, options.format))
      continue;
    if (field.name == depth_field && options.site_depth.size() == 0)
      options.site_depth = field.values;
    if (field.name != open_field || options.open_sites.size() > 0)
      continue;
    std::vector<std::int32_t> sites;
    for (std::int32_t i = 0; i < field.values.size(); ++i)
      if (field.values[i] > 0)
        sites.push_back(i);
    options.open_sites = Eigen::Map<const Ids>(sites.data(), std::ssize(sites));
  }
  std::erase_if(options.fields,
                [&](const MeshField& field) { return is_coast_field(field, options.format); });
}

ProgressCallback progress_from(const ProgressCallback& progress, double from) {
  if (!progress)
    return {};
  return [&progress, from](const Progress& part) {
    constexpr double end = 0.99; // the file has yet to be brought to the disk
    return progress({part.stage, from + (end - from) * part.fraction});
  };
}

} // namespace io_detail

namespace {

using namespace io_detail;

void require_ids(const std::string& path, const Mesh& mesh) {
  const std::int64_t sites = mesh.points.cols();
  if (!are_ids(mesh.triangles, sites) || !are_ids(mesh.site_of_input, sites))
    refuse_path(path, "the mesh has an id that is not one of its {} points", sites);
}

MeshSizes count_sizes(const Mesh& mesh) {
  return {mesh.points.cols(), mesh.triangles.cols(), mesh.closed()};
}

/// Whether the cells of a mesh are those that its surface's rings clip.
bool clips_cells(const Mesh& mesh, Format format) {
  return mesh.surface.is_bounded() && info_of(format).cells;
}

void require_mesh(const std::string& path, const Mesh& mesh, Format format) {
  require_ids(path, mesh);
  if (clips_cells(mesh, format)) {
    if (!find_row(format).polygons_as)
      refuse_path(path, "the format holds whole Voronoi cells, but the boundary of a region clips "
                        "those along it; write mpas");
    return;
  }
  if (info_of(format).cells && !mesh.closed())
    refuse_path(
        path,
        "the mesh is open, and its outer cells would reach round the far side of the sphere; "
        "write its triangles ({}), cut a limited area out of a wider grid, or add sites all "
        "around the sphere",
        triangle_formats(", "));
}

/// The mesh in a file's numbering, and the options' values with it.
Mesh renumbered_with_values(const Mesh& mesh, Numbering numbering, WriteOptions& options) {
  if (options.site_density.size() == 0 && options.site_depth.size() == 0 &&
      options.open_sites.size() == 0 && options.fields.empty())
    return renumbered(mesh, numbering);
  Mesh whole = mesh;
  whole.site_of_input = themselves(mesh.points.cols());
  Mesh out = renumbered(whole, numbering);
  renumber_values(mesh, out.site_of_input, options);
  return out;
}

/// \throws Error invalid_argument, for a field that the format cannot store.
void require_stored(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  const bool clipped = clips_cells(mesh, options.format),
             whole_plane = mesh.surface.is_bounded() && !mesh.surface.is_sphere();
  for (const MeshField& field : options.fields) {
    FieldFault fault = find_fault(options.format, field);
    if (fault == FieldFault::none && clipped && field.location != FieldLocation::cells)
      fault = FieldFault::location;
    if (fault == FieldFault::none && (clipped || whole_plane || mesh.closed()) &&
        is_computed(options.format, field))
      fault = FieldFault::name;
    if (fault != FieldFault::none)
      refuse_field(path, options.format, field, fault);
  }
}

void require_input_numbering(const std::string& path, Numbering numbering) {
  if (numbering == Numbering::curve)
    refuse_path(path, "the cells of a planar mesh keep their numbers; leave the order out");
}

/// Adds fields of cells that files of polygons do not compute.
void add_cell_fields(const Voronoi& voronoi, WriteOptions& options) {
  const CellFields fields = make_cell_fields(voronoi, options);
  options.fields.push_back({.name = "density", .values = fields.density});
  options.fields.push_back({.name = "spacing", .values = fields.spacing});
  options.fields.push_back({.name = "quality", .values = fields.quality});
  options.fields.push_back({.name = "degree", .values = fields.degree.cast<double>()});
}

/// Writes cells that a boundary clips.
void write_cells(const std::string& path, Voronoi cells, WriteOptions options) {
  if (options.format == Format::mpas) {
    Points3 points =
        cells.surface.is_sphere() ? on_sphere(cells.cells, options.sphere_radius) : Points3(3, 0);
    return write_mpas(path, std::move(cells), std::move(points), options);
  }
  if (options.format != Format::ugrid)
    add_cell_fields(cells, options);
  DoubleVector area = std::move(cells.cell_area);
  const CellGrid grid{polygons_of(std::move(cells)), std::move(area), {}};
  find_row(options.format).write_polygons(path, grid, options);
}

void write_plane(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  const Surface& surface = mesh.surface;
  WriteOptions resolved = options;
  resolved.format = format_of(path, options.format);
  require_planar_format(path, surface, resolved.format);
  take_coast_fields(resolved);
  if (options.site_density.size() == 0 && !options.density.uniform())
    resolved.site_density = evaluate(options.density, mesh.points, surface); // given by site
  resolved.density = {};
  require_options(path, resolved);
  require_input_numbering(path, options.numbering);
  require_ids(path, mesh);
  require_values(path, count_sizes(mesh), resolved);
  if (info_of(resolved.format).netcdf)
    replace_names(resolved.fields);
  require_stored(path, mesh, resolved);
  resolved.progress = progress_from(options.progress, 0);
  if (surface.is_bounded() && info_of(resolved.format).cells)
    write_cells(path, voronoi(mesh), resolved);
  else
    find_row(resolved.format).write_mesh(path, {mesh}, resolved);
  Monitor(options.progress).finish("write");
}

} // namespace

CoastChanges io_detail::write_sphere(const std::string& path, WrittenMesh mesh,
                                     const WriteOptions& options) {
  constexpr double numbered = 0.2; // share of the time if cells are renumbered
  WriteOptions resolved = options;
  resolved.format = format_of(path, options.format);
  take_coast_fields(resolved);
  require_options(path, resolved);
  require_mesh(path, mesh.mesh, resolved.format);
  require_values(path, count_sizes(mesh.mesh), resolved);
  if (info_of(resolved.format).netcdf)
    replace_names(resolved.fields);
  require_stored(path, mesh.mesh, resolved);
  Monitor monitor(options.progress);
  monitor.begin("number", numbered, 1);
  const Numbering numbering = choose_numbering(resolved);
  const bool stays = numbering == Numbering::input ||
                     (numbering == Numbering::curve && is_in_curve_order(mesh.mesh));
  resolved.progress = progress_from(options.progress, stays ? 0 : numbered);
  const FormatRow& format = find_row(resolved.format);
  CoastChanges changes;
  if (clips_cells(mesh.mesh, resolved.format)) {
    CoastalCells cells =
        coastal_cells(stays ? mesh.mesh : renumbered_with_values(mesh.mesh, numbering, resolved));
    changes = cells.changes;
    write_cells(path, std::move(cells.voronoi), resolved);
  } else if (stays) {
    format.write_mesh(path, mesh, resolved);
  } else {
    Mesh other = renumbered_with_values(mesh.mesh, numbering, resolved);
    if (mesh.own != nullptr)
      *mesh.own = {};
    format.write_mesh(path, {other, &other}, resolved);
  }
  monitor.finish("write");
  return changes;
}

void require_planar_format(const std::string& path, const Surface& plane, Format format) {
  const bool periodic = plane.period().maxCoeff() > 0, bounded = plane.is_bounded();
  const Planes& planes = find_row(format).planes;
  if (periodic ? planes.periodic : planes.whole || (bounded && planes.clipped))
    return;
  const std::string triangles = triangle_formats();
  if (bounded)
    refuse_path(path,
                "the cells of a bounded plane are written as {}, its triangles as {}; give one of "
                "these formats",
                clipped_formats(), triangles);
  if (periodic)
    refuse_path(path, "a periodic plane is written as MPAS or as triangles alone; give a name that "
                      "ends in .nc, .txt or .tri");
  refuse_path(path,
              "a plane is written as triangles, {}, and as cells only within a domain, which clips "
              "them; give a name that ends so, or convert that file with its domain",
              triangles);
}

void write(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  if (mesh.surface.is_sphere())
    write_sphere(path, {mesh}, options);
  else
    write_plane(path, mesh, options);
}

void write(const std::string& path, Mesh&& mesh, const WriteOptions& options) {
  if (mesh.surface.is_sphere())
    write_sphere(path, {mesh, &mesh}, options);
  else
    write_plane(path, mesh, options);
  mesh = {};
}

} // namespace calotte
