// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/cells/cell_rows.h"
#include "io/cells/mesh_intake.h"
#include "io/cells/model_grid.h"
#include "io/command.h"
#include "io/formats/format_table.h"
#include "io/formats/formats.h"
#include "io/mpas/mpas.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/error.h>
#include <calotte/mesh_file.h>
#include <calotte/write.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

// ---- Which format

/// Whether a file is NetCDF, by its name; by its contents, if the name does not determine a format.
/// \throws Error invalid_argument, if neither determines a format.
bool is_netcdf_mesh(const std::string& path) {
  const std::optional<Format> format = format_of_name(path);
  if (!format && !is_netcdf_file(path)) {
    refuse_foreign(path);
    refuse_name(path);
  }
  return !format || info_of(*format).netcdf;
}

[[noreturn]] void refuse_triangles_alone(const std::string& path) {
  base_detail::refuse(message("{} holds triangles only; give the points they refer to", path));
}

// ---- Files of each kind

/// The row that reads a file, and the file, opened if it is NetCDF.
struct OpenFile {
  explicit OpenFile(const std::string& path) {
    if (!is_netcdf_mesh(path)) {
      row = &find_row(*format_of_name(path));
      return;
    }
    netcdf.emplace(path);
    row = find_row(*netcdf);
    if (row == nullptr)
      refuse_netcdf(*netcdf);
  }

  InputFile input(const std::string& path, FieldChoice fields) const {
    return {path, netcdf ? &*netcdf : nullptr, fields};
  }

  const FormatRow* row = nullptr;
  std::optional<NetcdfReader> netcdf;
};

/// MeshFile::planet_radius. \param netcdf the file, if it is one.
std::optional<double> find_planet(const MeshFile& content, Format format,
                                  const NetcdfReader* netcdf) {
  const double radius = content.sphere_radius;
  if (!content.surface().is_sphere())
    return std::nullopt;
  if (radius > 6300 && radius < 6400) // as in JIGSAW's meshes
    return 1000 * radius;
  if (radius != 1)
    return netcdf != nullptr ? std::optional(radius) : std::nullopt;
  for (const char* const name : {planet_attribute, "sphere_radius"}) // of longitudes and latitudes
    if (const double named = netcdf != nullptr ? netcdf->number("", name, 0) : 0;
        named >= smallest_planet && std::isfinite(named))
      return named;
  const auto is_its = [&](const ModelNeeds& model) {
    return suits(model, format, radius, content.vertex_order);
  };
  const auto model = std::ranges::find_if(models(), is_its);
  return model == models().end() ? std::nullopt : std::optional(model->planet_radius);
}

/// Points with z = 0 are those of a plane, in a format that does not say it itself.
void set_surface(const FormatRow& row, RawMesh& raw) {
  if (raw.surface.is_sphere() && row.reads_planes && lies_in_plane(raw.points))
    raw.surface = Surface::plane();
}

MeshFile read_any(const std::string& path, FieldChoice choice) {
  const OpenFile file(path);
  if (file.row->read == nullptr)
    refuse_triangles_alone(path);
  RawMesh raw = file.row->read(file.input(path, choice));
  set_surface(*file.row, raw);
  MeshFile content = make_mesh_file(path, file.row->label, std::move(raw));
  content.planet_radius =
      find_planet(content, file.row->info.format, file.netcdf ? &*file.netcdf : nullptr);
  return content;
}

// ---- Points alone

/// The sites, and of the sphere only these where reading the rest is slow or may fail.
/// \throws Error invalid_argument, for cells without centres.
RawMesh read_raw_sites(const std::string& path) {
  const OpenFile file(path);
  const InputFile input = file.input(path, FieldChoice::none);
  if (file.row->read_sites != nullptr && !(file.netcdf && is_planar_mpas(*file.netcdf))) {
    RawMesh sites{.points = file.row->read_sites(input)};
    set_surface(*file.row, sites);
    return sites;
  }
  if (file.row->read == nullptr)
    refuse_triangles_alone(path);
  RawMesh raw = file.row->read(input);
  if (raw.points.cols() == 0 && raw.polygons.size() > 0)
    refuse_path(path, "its cells have no centres, so it has no sites; "
                      "read them with read_mesh_file()");
  set_surface(*file.row, raw);
  return raw;
}

} // namespace

SitesOfFile read_sites_and_surface(const std::string& path) {
  RawMesh raw = read_raw_sites(path);
  require_points(path, raw);
  return {std::move(raw.points), std::move(raw.surface)};
}

bool is_netcdf_file(const std::string& path) {
  if (std::error_code error; !std::filesystem::is_regular_file(path, error))
    return false;
  std::array<char, 4> start{};
  std::ifstream in = open_geometries(path);
  read_some(in, start.data(), std::ssize(start), path);
  const std::string_view bytes(start.data(), start.size());
  return bytes.starts_with("CDF") || bytes == "\x89HDF";
}

bool is_netcdf(const MeshFile& file) {
  const auto table = format_table();
  return std::any_of(table.begin(), table.end(), [&](const FormatRow& row) {
    return row.label == file.format && row.info.netcdf;
  });
}

MeshFile read_mesh_file(const std::string& path, const Points3* points, FieldChoice choice) {
  if (!points || format_of_name(path) != Format::triangles)
    return read_any(path, choice);
  std::ifstream in = open_input(path);
  MeshFile file =
      make_mesh_file_on_points(path, *points, get_triangles_text(in, path, points->cols()));
  file.planet_radius = find_planet(file, Format::triangles, nullptr);
  return file;
}

MeshFile read_mesh_file(const std::string& path, const Points3* points, FieldChoice choice,
                        const std::vector<FieldIndex>& choices) {
  if (choices.empty() || choice == FieldChoice::none)
    return read_mesh_file(path, points, choice);
  MeshFile file = read_mesh_file(path, points, FieldChoice::all);
  file.fields = named(path, [&] { return fields_at(std::move(file.fields), choices); });
  const auto has_several = [&](const MeshField& field) {
    return choice == FieldChoice::scalars && field.count() > 1;
  };
  for (const MeshField& field : file.fields)
    if (has_several(field))
      file.ignored.push_back(field.name);
  std::erase_if(file.fields, has_several);
  return file;
}

Mesh read_mesh(const std::string& path, const Points3* points) {
  MeshFile file = read_mesh_file(path, points, FieldChoice::none);
  if (file.other_cells() && !file.plane())
    refuse_path(path,
                "the cells are not the Voronoi cells of their centres ({}); read them with "
                "read_mesh_file(), or read their centres with read_sites() and triangulate these",
                file.not_voronoi.text());
  return std::move(*file.mesh);
}

Points3 read_sites(const std::string& path) {
  auto [sites, surface] = read_sites_and_surface(path);
  base_detail::require(surface.is_sphere(),
                       "{} holds a mesh of the plane, not of the sphere; read it with read_mesh()",
                       path);
  return sites;
}

} // namespace calotte
