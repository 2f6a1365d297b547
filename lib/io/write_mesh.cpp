// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/field_order.h"
#include "io/file.h"
#include "io/file_names.h"
#include "io/formats.h"
#include "io/model_grid.h"
#include "io/written_fields.h"
#include "io/written_values.h"

#include "base/monitor.h"
#include "base/points.h"
#include "mesh/ids.h"
#include "mesh/renumber.h"

#include <calotte/check.h>
#include <calotte/error.h>
#include <calotte/mesh_file.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace calotte {
namespace {

using namespace io_detail;

[[noreturn]] void refuse(const std::string& path, const std::string& problem) {
  throw Error(ErrorCode::bad_option, path + ": " + problem);
}

void require_options(const std::string& path, const WriteOptions& options) {
  if (!(options.sphere_radius > 0 && std::isfinite(options.sphere_radius)))
    refuse(path, "the sphere's radius is " + std::to_string(options.sphere_radius) +
                     "; give a positive number");
  evaluate(options.density, Points3(3, 0)); // throws where it is ill-formed
}

/// Of either kind of mesh.
template <class AnyMesh> void require_ids(const std::string& path, const AnyMesh& mesh) {
  const std::int64_t sites = mesh.points.cols();
  if (!are_ids(mesh.triangles, sites) || !are_ids(mesh.site_of_input, sites))
    refuse(path, "the mesh has an id that is not one of its " + std::to_string(sites) + " points");
}

MeshSizes sizes_of(const Mesh& mesh) {
  return {mesh.points.cols(), mesh.triangles.cols(), mesh.closed()};
}
MeshSizes sizes_of(const PlanarMesh& mesh) {
  return {mesh.points.cols(), mesh.triangles.cols(), mesh.period.minCoeff() > 0};
}

void require_mesh(const std::string& path, const Mesh& mesh, Format format) {
  require_ids(path, mesh);
  if (holds_cells(format) && !mesh.closed())
    refuse(path, "the mesh is open, and its outer cells have no end; write its triangles (.vtp, "
                 ".vtu, .off, .ply, .msh), or add sites all around the sphere");
}

Numbering numbering_of(const WriteOptions& options) {
  if (options.numbering != Numbering::by_format)
    return options.numbering;
  return is_netcdf(options.format) ? Numbering::curve : Numbering::input;
}

/// A file from front to back.
template <class Put>
void put_file(const std::string& path, const ProgressCallback& progress, std::int64_t expected,
              const Put& put) {
  OutputFile file(path);
  file.watch(progress, expected);
  put([&](std::string_view bytes) { file.append(bytes); });
  file.commit();
}

void put_mesh(const Sink& sink, const Mesh& mesh, const WriteOptions& options) {
  switch (options.format) {
  case Format::vtp:
    return put_vtp(sink, mesh, options);
  case Format::vtu:
    return put_vtu(sink, mesh, options);
  case Format::vtp_cells:
    return put_vtp_cells(sink, mesh, options);
  case Format::vtu_cells:
    return put_vtu_cells(sink, mesh, options);
  case Format::geojson:
    return put_geojson(sink, mesh, options);
  case Format::off:
    return put_off(sink, mesh);
  case Format::ply:
    return put_ply(sink, mesh);
  case Format::msh:
    return put_msh(sink, mesh);
  default:
    return put_triangles_text(sink, mesh);
  }
}

/// A site's share of a file, roughly: progress alone depends on it.
std::int64_t expected_bytes(Format format) {
  switch (format) {
  case Format::ply:
  case Format::triangles:
    return 50;
  case Format::geojson:
    return 600;
  case Format::vtp_cells:
  case Format::vtu_cells:
    return 200;
  default:
    return 100;
  }
}

/// A caller's callback for the part of a run from one fraction on.
ProgressCallback rest_of(const ProgressCallback& progress, double from) {
  if (!progress)
    return {};
  return [&progress, from](const Progress& part) {
    constexpr double end = 0.99; // the file has yet to be brought to the disk
    return progress({part.stage, from + (end - from) * part.fraction});
  };
}

void write_numbered(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  switch (options.format) {
  case Format::mpas:
    return write_mpas(path, mesh, options);
  case Format::mpas_minimal:
    return write_mpas_minimal(path, mesh, options);
  case Format::ugrid:
    return write_ugrid(path, cell_grid(mesh), options);
  case Format::ugrid_triangles:
    return write_ugrid_triangles(path, mesh, options);
  case Format::scrip:
    return write_scrip(path, cell_grid(mesh), options);
  case Format::esmf:
    return write_esmf(path, cell_grid(mesh), options);
  case Format::exodus:
    return write_exodus(path, cell_grid(mesh), options);
  case Format::fesom:
    return write_fesom(path, mesh, options);
  case Format::mpi_scvt:
    return write_mpi_scvt(path, mesh, options);
  default:
    put_file(path, options.progress, expected_bytes(options.format) * mesh.points.cols(),
             [&](const Sink& sink) { put_mesh(sink, mesh, options); });
  }
}

/// The mesh in a file's numbering, and the options' values with it.
Mesh renumbered_with_values(const Mesh& mesh, Numbering numbering, WriteOptions& options) {
  if (options.site_density.size() == 0 && options.fields.empty())
    return renumbered(mesh, numbering);
  Mesh whole = mesh;
  whole.site_of_input = themselves(mesh.points.cols());
  Mesh out = renumbered(whole, numbering);
  renumber_values(mesh, out.site_of_input, options);
  return out;
}

/// At z = 0.
Mesh in_space(const PlanarMesh& mesh) {
  Mesh out{Points3::Zero(3, mesh.points.cols()), mesh.triangles, mesh.neighbours,
           mesh.site_of_input};
  out.points.topRows<2>() = mesh.points;
  return out;
}

} // namespace

void write(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  constexpr double numbered = 0.2; // of the time, where the cells are numbered anew
  WriteOptions resolved = options;
  resolved.format = format_of(path, options.format);
  require_options(path, resolved);
  require_mesh(path, mesh, resolved.format);
  require_values(path, sizes_of(mesh), resolved);
  if (is_netcdf(resolved.format))
    settle_names(resolved.fields);
  Monitor monitor(options.progress);
  monitor.begin("number", numbered, 1);
  const Numbering numbering = numbering_of(resolved);
  const bool stays =
      numbering == Numbering::input || (numbering == Numbering::curve && is_in_curve_order(mesh));
  resolved.progress = rest_of(options.progress, stays ? 0 : numbered);
  if (stays)
    write_numbered(path, mesh, resolved);
  else
    write_numbered(path, renumbered_with_values(mesh, numbering, resolved), resolved);
  monitor.finish("write");
}

void require_planar_format(const std::string& path, bool periodic, Format format) {
  const bool mpas = format == Format::mpas || format == Format::mpas_minimal;
  const bool places = format == Format::vtp || format == Format::vtu || format == Format::off ||
                      format == Format::ply || format == Format::msh;
  if (format == Format::triangles || (periodic ? mpas : places))
    return;
  refuse(path, periodic ? "a periodic plane is written as MPAS or as triangles alone; give a name "
                          "that ends in .nc, .txt or .tri"
                        : "a plane is written as triangles, .vtp, .vtu, .off, .ply or .msh; give a "
                          "name that ends so");
}

void write(const std::string& path, const PlanarMesh& mesh, const WriteOptions& options) {
  WriteOptions resolved = options;
  resolved.format = format_of(path, options.format);
  require_options(path, resolved);
  require_planar_format(path, mesh.period.minCoeff() > 0, resolved.format);
  if (options.numbering == Numbering::curve || options.numbering == Numbering::rcm)
    refuse(path, "the cells of a planar mesh keep their numbers; leave the order out");
  require_ids(path, mesh);
  require_values(path, sizes_of(mesh), resolved);
  if (is_netcdf(resolved.format))
    settle_names(resolved.fields);
  resolved.progress = rest_of(options.progress, 0);
  if (resolved.format == Format::mpas)
    write_mpas(path, mesh, resolved);
  else if (resolved.format == Format::mpas_minimal)
    write_mpas_minimal(path, mesh, resolved);
  else
    write_numbered(path, in_space(mesh), resolved);
  Monitor(options.progress).finish("write");
}

namespace {

void put_polygons(const Sink& sink, const Polygons& polygons, const WriteOptions& options) {
  switch (options.format) {
  case Format::vtp_cells:
    return put_vtp_cells(sink, polygons, options);
  case Format::vtu_cells:
    return put_vtu_cells(sink, polygons, options);
  default:
    return put_geojson(sink, polygons, options);
  }
}

void write_polygons(const std::string& path, const Polygons& polygons,
                    const WriteOptions& options) {
  switch (options.format) {
  case Format::ugrid:
    return write_ugrid(path, cell_grid(polygons), options);
  case Format::scrip:
    return write_scrip(path, cell_grid(polygons), options);
  case Format::esmf:
    return write_esmf(path, cell_grid(polygons), options);
  case Format::exodus:
    return write_exodus(path, cell_grid(polygons), options);
  default:
    put_file(path, options.progress, expected_bytes(options.format) * polygons.size(),
             [&](const Sink& sink) { put_polygons(sink, polygons, options); });
  }
}

/// \throws Error bad_option, where the format does not hold cells of any shape.
void require_polygon_format(const std::string& path, const MeshFile& file, Format format) {
  if (format == Format::mpas || format == Format::mpas_minimal)
    refuse(path, "MPAS needs Voronoi cells on the whole sphere, but " + file.not_voronoi +
                     "; write ugrid, scrip, esmf, exodus, vtp-cells, vtu-cells or geojson");
  if (!holds_cells(format))
    refuse(path, "the format holds triangles, but the mesh consists of cells, and " +
                     file.not_voronoi +
                     "; write ugrid, scrip, esmf, exodus, vtp-cells, vtu-cells or geojson");
  if (format == Format::scrip && file.polygons->centres.cols() == 0)
    refuse(path, "SCRIP needs the centre of each cell, but the cells have none; write ugrid, esmf, "
                 "exodus, vtp-cells, vtu-cells or geojson");
  const auto& begin = file.polygons->begin;
  for (std::int64_t i = 0; i < file.polygons->size(); ++i)
    if (begin[i] == begin[i + 1])
      refuse(path, "cell " + std::to_string(i) +
                       " has an incomplete boundary, which no format of cells can hold; write the "
                       "triangles (.vtp, .vtu, .off, .ply, .msh)");
}

/// Whether a field is of polygons: at the cells, or at their corners.
bool is_of(const Polygons& polygons, const MeshField& field) {
  return field.location == Location::cells ||
         (field.location == Location::vertices && has_values_for(field, polygons.corners.cols()));
}

void write_polygons_of(const std::string& path, const MeshFile& file, WriteOptions options) {
  require_options(path, options);
  require_polygon_format(path, file, options.format);
  std::erase_if(options.fields,
                [&](const MeshField& field) { return !is_of(*file.polygons, field); });
  if (file.density.size() == file.polygons->size())
    options.fields.push_back({.name = "density", .values = file.density});
  if (is_netcdf(options.format))
    settle_names(options.fields);
  write_polygons(path, *file.polygons, options);
  Monitor(options.progress).finish("write");
}

/// Cells that are not Voronoi cells are written as they are; triangles of the same file only to
/// formats of triangles.
bool writes_polygons(const MeshFile& file, Format format) {
  return file.polygons && (holds_cells(format) || !file.mesh || file.mesh->closed());
}

/// Voronoi cells exist only for a Delaunay triangulation, of which edges between cocircular sites
/// may be the others.
void require_voronoi(const std::string& path, const Mesh& mesh, Format format) {
  if (!holds_cells(format))
    return;
  const EdgeCounts edges = count_edges(mesh);
  if (edges.not_delaunay > 0)
    refuse(path, "the mesh has " + std::to_string(edges.not_delaunay) +
                     " edges that are not Delaunay (the first is from site " +
                     std::to_string(edges.first[0]) + " to " + std::to_string(edges.first[1]) +
                     "), so it has no Voronoi cells; write its triangles (.vtp, .vtu, .off, .ply, "
                     ".msh), or triangulate its points anew");
}

/// Names of the fields that a format cannot hold.
std::vector<std::string> dropped_fields(const MeshFile& file, Format format, bool polygons) {
  std::vector<std::string> dropped;
  for (const MeshField& field : file.fields)
    if (!holds_field(format, field) || (polygons && !is_of(*file.polygons, field)))
      dropped.push_back(field.name);
  return dropped;
}

} // namespace

WrittenFields write(const std::string& path, const MeshFile& file, const WriteOptions& options) {
  WriteOptions resolved = options;
  resolved.format = format_of(path, options.format);
  resolved.fields.insert(resolved.fields.end(), file.fields.begin(), file.fields.end());
  WrittenFields written;
  if (is_netcdf(resolved.format))
    written.renamed = settle_names(resolved.fields);
  const bool polygons = writes_polygons(file, resolved.format);
  if (!polygons && options.density.uniform() && options.site_density.size() == 0)
    resolved.site_density = file.density;
  if (polygons) {
    write_polygons_of(path, file, resolved);
  } else if (file.plane) {
    write(path, *file.plane, resolved);
  } else {
    require_voronoi(path, *file.mesh, resolved.format);
    write(path, *file.mesh, resolved);
  }
  written.dropped = dropped_fields(file, resolved.format, polygons);
  return written;
}

} // namespace calotte
