// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/cells/cell_rows.h"
#include "io/cells/mesh_intake.h"
#include "io/command.h"
#include "io/formats/formats.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/error.h>
#include <calotte/mesh_file.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

namespace calotte {
namespace {

using namespace io_detail;

// ---- Which format

/// Whether the file is NetCDF: its name says so, or its contents where the name says nothing.
/// \throws Error invalid_argument, where neither says a format.
bool holds_netcdf(const std::string& path) {
  const std::optional<Format> format = format_of_name(path);
  if (!format && !is_netcdf_file(path))
    refuse_name(path);
  return !format || is_netcdf(*format);
}

[[noreturn]] void refuse_triangles_alone(const std::string& path) {
  throw Error(ErrorCode::invalid_argument,
              path + " holds triangles only; give the points they refer to");
}

// ---- Files of each kind

/// Formats that hold points in space may hold a mesh of the plane.
MeshFile mesh_file_of_any(const std::string& path, const std::string& format, RawMesh raw) {
  return lies_in_plane(raw.points) ? planar_mesh_file_of(path, format, std::move(raw))
                                   : mesh_file_of(path, format, std::move(raw));
}

MeshFile read_netcdf(const std::string& path, FieldChoice choice) {
  const NetcdfReader file(path);
  if (is_mpas(file))
    return is_planar_mpas(file) ? read_planar_mpas(file, choice)
                                : mesh_file_of(path, "MPAS", read_mpas(file, choice));
  if (is_ugrid(file))
    return mesh_file_of_any(path, "UGRID", read_ugrid(file, choice));
  if (is_scrip(file))
    return mesh_file_of(path, "SCRIP", read_scrip(file, choice));
  if (is_esmf(file))
    return mesh_file_of(path, "ESMF", read_esmf(file, choice));
  if (is_exodus(file))
    return mesh_file_of(path, "Exodus", read_exodus(file, choice));
  if (is_icon(file))
    return mesh_file_of(path, "ICON", read_icon(file, choice));
  if (const std::optional<CellRows> rows = cell_rows_of(file))
    return mesh_file_of(path, "CF", read_cells(file, *rows, choice));
  refuse_netcdf(file);
}

/// MPI-SCVT's centres of regions. Its triangles of these say nothing that the centres do not, so
/// that either file stands for both. Nothing where the name is none of the two.
std::optional<RawMesh> read_centres(const std::string& path) {
  if (format_of_name(path).value_or(Format::triangles) != Format::triangles)
    return std::nullopt;
  if (sibling(path, centres_name, centres_name))
    return RawMesh{read_points(path)};
  const std::optional<std::string> centres = sibling(path, centre_triangles_name, centres_name);
  if (!centres)
    return std::nullopt;
  if (!std::ifstream(*centres))
    throw Error(ErrorCode::file, path + ": it holds the centres' triangles only, and " + *centres +
                                     ", which holds the centres, cannot be read; put it there");
  return RawMesh{read_points(*centres)};
}

RawMesh read_stream(const std::string& path, Format format) {
  std::ifstream in = open_input(path);
  switch (format) {
  case Format::vtp:
  case Format::vtu:
    return get_vtk_xml(in, path);
  case Format::vtk:
    return get_vtk_legacy(in, path);
  case Format::off:
    return get_off(in, path);
  case Format::ply:
    return get_ply(in, path);
  case Format::msh:
    return get_msh(in, path);
  default:
    return get_geojson(in, path);
  }
}

std::string name_of(Format format) {
  switch (format) {
  case Format::vtp:
  case Format::vtu:
  case Format::vtk:
    return "VTK";
  case Format::off:
    return "OFF";
  case Format::ply:
    return "PLY";
  case Format::msh:
    return "MSH";
  case Format::mpi_scvt:
    return "MPI-SCVT";
  default:
    return "GeoJSON";
  }
}

MeshFile read_any(const std::string& path, FieldChoice choice) {
  if (std::optional<RawMesh> centres = read_centres(path))
    return mesh_file_of(path, name_of(Format::mpi_scvt), *std::move(centres));
  if (holds_netcdf(path))
    return read_netcdf(path, choice);
  const std::optional<Format> format = format_of_name(path);
  if (*format == Format::triangles)
    refuse_triangles_alone(path);
  if (*format == Format::fesom)
    return mesh_file_of(path, "FESOM", read_fesom(path));
  return mesh_file_of_any(path, name_of(*format),
                          *format == Format::mpi_scvt ? read_mpi_scvt(path)
                                                      : read_stream(path, *format));
}

// ---- Points alone

/// \throws Error invalid_argument, for cells without centres.
Points3 sites_of(const std::string& path, RawMesh raw) {
  if (raw.points.cols() == 0 && raw.polygons.size() > 0)
    throw Error(ErrorCode::invalid_argument, path +
                                                 ": its cells have no centres, so it has no sites; "
                                                 "read them with read_mesh_file()");
  return std::move(raw.points);
}

/// Without what goes with them where that costs a look or may fail.
Points3 sites_of(const std::string& path) {
  if (std::optional<RawMesh> centres = read_centres(path))
    return std::move(centres->points);
  const std::optional<Format> format = format_of_name(path);
  if (format == Format::mpi_scvt)
    return read_points(path);
  if (format == Format::fesom)
    return read_fesom(path).points;
  if (format == Format::triangles)
    refuse_triangles_alone(path);
  if (!holds_netcdf(path))
    return sites_of(path, read_stream(path, *format));
  const NetcdfReader file(path);
  if (is_mpas(file))
    return read_mpas_sites(file);
  if (is_ugrid(file))
    return sites_of(path, read_ugrid(file, FieldChoice::none));
  if (is_scrip(file))
    return sites_of(path, read_scrip(file, FieldChoice::none));
  if (is_esmf(file))
    return sites_of(path, read_esmf(file, FieldChoice::none));
  if (is_exodus(file))
    return sites_of(path, read_exodus(file, FieldChoice::none));
  if (is_icon(file))
    return sites_of(path, read_icon(file, FieldChoice::none));
  if (const std::optional<CellRows> rows = cell_rows_of(file))
    return sites_of(path, read_cells(file, *rows, FieldChoice::none));
  refuse_netcdf(file);
}

} // namespace

bool is_netcdf_file(const std::string& path) {
  if (std::error_code error; !std::filesystem::is_regular_file(path, error))
    return false;
  std::array<char, 4> start{};
  std::ifstream in = open_input(path);
  read_some(in, start.data(), std::ssize(start), path);
  const std::string_view bytes(start.data(), start.size());
  return bytes.starts_with("CDF") || bytes == "\x89HDF";
}

MeshFile read_mesh_file(const std::string& path, const Points3* points, FieldChoice choice) {
  if (!points || format_of_name(path) != Format::triangles)
    return read_any(path, choice);
  std::ifstream in = open_input(path);
  return mesh_file_of_columns(path, *points, get_triangles_text(in, path, points->cols()));
}

Mesh read_mesh(const std::string& path, const Points3* points) {
  MeshFile file = read_mesh_file(path, points, FieldChoice::none);
  if (file.polygons && !file.plane() && !(file.mesh && !file.mesh->closed()))
    throw Error(ErrorCode::invalid_argument,
                path +
                    ": the cells are not the Voronoi cells of their "
                    "centres (" +
                    file.not_voronoi +
                    "); read them with read_mesh_file(), or read their "
                    "centres with read_sites() and triangulate these");
  return std::move(*file.mesh);
}

Points3 read_sites(const std::string& path) {
  Points3 sites = sites_of(path);
  require_sphere(path, sites);
  require_directions(path, sites);
  return sites;
}

} // namespace calotte
