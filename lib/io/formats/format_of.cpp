// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_names.h"
#include "io/bytes/text.h"
#include "io/cells/written_fields.h"
#include "io/formats/formats.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

namespace calotte {
namespace io_detail {
namespace {

struct Suffix {
  std::string_view text;
  Format format; ///< by default
};

constexpr std::array suffixes{
    Suffix{".nc", Format::mpas},         Suffix{".vtp", Format::vtp},
    Suffix{".vtu", Format::vtu},         Suffix{".off", Format::off},
    Suffix{".ply", Format::ply},         Suffix{".msh", Format::msh},
    Suffix{".txt", Format::triangles},   Suffix{".tri", Format::triangles},
    Suffix{".geojson", Format::geojson}, Suffix{".g", Format::exodus},
    Suffix{".exo", Format::exodus},      Suffix{".vtk", Format::vtk}};

/// The format that stands for those of one suffix.
Format of_suffix(Format format) {
  switch (format) {
  case Format::mpas_minimal:
  case Format::ugrid:
  case Format::ugrid_triangles:
  case Format::scrip:
  case Format::esmf:
    return Format::mpas;
  case Format::vtp_cells:
    return Format::vtp;
  case Format::vtu_cells:
    return Format::vtu;
  default:
    return format;
  }
}

/// Whether formats of pictures make data of that name at all cells. Those that they make at Voronoi
/// cells alone are derived from the mesh.
bool is_own_property(const std::string& name) { return name == "area" || name == "site"; }

/// Whether GeoJSON has a property of that name besides.
bool is_place_property(const std::string& name) {
  return name == "id" || name == "x" || name == "y" || name == "z";
}

std::string name_of(const std::string& path) { return std::filesystem::path(path).filename(); }

} // namespace

std::string suffix_of(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

bool is_netcdf(Format format) {
  return of_suffix(format) == Format::mpas || format == Format::exodus;
}

std::optional<Format> format_of_name(const std::string& path) {
  const std::string suffix = suffix_of(path);
  if (name_of(path) == fesom_nodes_name)
    return Format::fesom;
  const auto* const known = std::find_if(suffixes.begin(), suffixes.end(),
                                         [&](const Suffix& s) { return s.text == suffix; });
  // SaveVertices.vtp is what somebody makes of SaveVertices.
  if (name_of(path).starts_with(vertices_name) &&
      (known == suffixes.end() || known->text == ".txt"))
    return Format::mpi_scvt;
  return known == suffixes.end() ? std::nullopt : std::optional(known->format);
}

bool holds_field(Format format, const MeshField& field) {
  switch (format) {
  case Format::mpas:
    return can_hold(mpas_names(), field);
  case Format::mpas_minimal:
    return field.location != Location::edges && can_hold(mpas_names(), field);
  case Format::ugrid:
  case Format::ugrid_triangles:
    return can_hold(ugrid_names(format == Format::ugrid), field);
  case Format::scrip:
    return can_hold(scrip_names(), field);
  case Format::esmf:
    return can_hold(esmf_names(), field);
  case Format::exodus:
    return can_hold(exodus_names(), field);
  case Format::vtp:
  case Format::vtu:
  case Format::vtp_cells:
  case Format::vtu_cells:
    return field.location != Location::edges && field.count() == 1 &&
           !(field.location == Location::cells && is_own_property(field.name));
  case Format::geojson:
    return field.location == Location::cells && field.count() == 1 &&
           !is_own_property(field.name) && !is_place_property(field.name);
  default:
    return false;
  }
}

std::optional<std::string> sibling(const std::string& path, std::string_view stem,
                                   std::string_view other) {
  const std::string name = name_of(path);
  if (!name.starts_with(stem))
    return std::nullopt;
  const std::filesystem::path file(path);
  return (file.parent_path() / (std::string(other) + name.substr(stem.size()))).string();
}

void refuse_name(const std::string& path) {
  const std::string suffix = suffix_of(path);
  throw Error(
      ErrorCode::invalid_argument,
      path + ": " + (suffix.empty() ? "no suffix" : "unknown suffix " + in_quotes(suffix)) +
          "; a mesh file ends in .nc, .vtp, .vtu, .vtk (read only), .off, .ply, .msh, .geojson, "
          ".g, .exo, .txt or .tri, or is named SaveVertices or nod2d.out");
}

} // namespace io_detail

using namespace io_detail;

const std::vector<std::pair<std::string, Format>>& format_words() {
  static const std::vector<std::pair<std::string, Format>> words{
      {"mpas", Format::mpas},
      {"mpas-minimal", Format::mpas_minimal},
      {"ugrid", Format::ugrid},
      {"ugrid-triangles", Format::ugrid_triangles},
      {"scrip", Format::scrip},
      {"esmf", Format::esmf},
      {"vtp", Format::vtp},
      {"vtu", Format::vtu},
      {"vtp-cells", Format::vtp_cells},
      {"vtu-cells", Format::vtu_cells},
      {"off", Format::off},
      {"ply", Format::ply},
      {"triangles", Format::triangles},
      {"mpi-scvt", Format::mpi_scvt},
      {"msh", Format::msh},
      {"geojson", Format::geojson},
      {"exodus", Format::exodus},
      {"fesom", Format::fesom}};
  return words;
}

Format format_of(const std::string& path, Format option) {
  const std::optional<Format> named = format_of_name(path);
  if (named == Format::vtk || option == Format::vtk)
    throw Error(ErrorCode::invalid_argument,
                path + ": legacy VTK files are read, but not written; write .vtp or .vtu");
  if (option == Format::by_name) {
    if (!named)
      refuse_name(path);
    return *named;
  }
  if (option == Format::fesom && named != Format::fesom)
    throw Error(ErrorCode::invalid_argument, path + ": files of that format are named " +
                                                 std::string(fesom_nodes_name) +
                                                 "; give that name");
  if (option == Format::mpi_scvt && named != Format::mpi_scvt)
    throw Error(ErrorCode::invalid_argument, path + ": files of that format are named " +
                                                 std::string(vertices_name) +
                                                 " and so on; give such a name");
  if (named && of_suffix(option) != *named)
    throw Error(
        ErrorCode::invalid_argument,
        path + ": its name belongs to another format than the selected one; change one of them");
  return option;
}

bool holds_cells(Format format) {
  switch (format) {
  case Format::mpas:
  case Format::mpas_minimal:
  case Format::ugrid:
  case Format::scrip:
  case Format::esmf:
  case Format::vtp_cells:
  case Format::vtu_cells:
  case Format::geojson:
  case Format::exodus:
    return true;
  default:
    return false;
  }
}

} // namespace calotte
