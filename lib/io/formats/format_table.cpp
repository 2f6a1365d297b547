// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/format_table.h"

#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/cells/cell_rows.h"
#include "io/cells/field_index.h"
#include "io/cells/model_grid.h"
#include "io/formats/formats.h"
#include "io/formats/write_mesh.h"
#include "io/netcdf/netcdf_reader.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace calotte::io_detail {
namespace {

// ---- Writers as the table has them

template <void (*put)(const Sink&, const Mesh&, const WriteOptions&)>
void to_stream(const std::string& path, WrittenMesh mesh, const WriteOptions& options) {
  put_file(path, options, mesh.mesh.points.cols(),
           [&](const Sink& sink) { put(sink, mesh.mesh, options); });
}

template <void (*put)(const Sink&, const Mesh&)>
void to_stream(const std::string& path, WrittenMesh mesh, const WriteOptions& options) {
  put_file(path, options, mesh.mesh.points.cols(), [&](const Sink& sink) { put(sink, mesh.mesh); });
}

template <void (*put)(const Sink&, const Polygons&, const WriteOptions&)>
void polygons_to_stream(const std::string& path, const CellGrid& grid,
                        const WriteOptions& options) {
  put_file(path, options, grid.polygons.size(),
           [&](const Sink& sink) { put(sink, grid.polygons, options); });
}

template <void (*put)(const Sink&, const Polygons&)>
void polygons_to_stream(const std::string& path, const CellGrid& grid,
                        const WriteOptions& options) {
  put_file(path, options, grid.polygons.size(),
           [&](const Sink& sink) { put(sink, grid.polygons); });
}

template <void (*write)(const std::string&, const Mesh&, const WriteOptions&)>
void to_files(const std::string& path, WrittenMesh mesh, const WriteOptions& options) {
  write(path, mesh.mesh, options);
}

template <void (*write)(const std::string&, Mesh, const WriteOptions&)>
void used_up(const std::string& path, WrittenMesh mesh, const WriteOptions& options) {
  write(path, mesh.take(), options);
}

template <void (*write)(const std::string&, const CellGrid&, const WriteOptions&)>
void as_grid(const std::string& path, WrittenMesh mesh, const WriteOptions& options) {
  write(path, cell_grid(mesh.mesh), options);
}

// ---- Readers

template <RawMesh (*get)(std::istream&, const std::string&)>
RawMesh from_stream(const InputFile& file) {
  std::ifstream in = open_input(file.path);
  return get(in, file.path);
}

template <RawMesh (*read)(const NetcdfReader&, FieldChoice)>
RawMesh from_netcdf(const InputFile& file) {
  return read(*file.netcdf, file.fields);
}

template <RawMesh (*read)(const std::string&)> RawMesh from_files(const InputFile& file) {
  return read(file.path);
}

bool has_cell_rows(const NetcdfReader& file) { return find_cell_rows(file).has_value(); }

RawMesh read_cell_rows_of(const InputFile& file) {
  return read_cells(*file.netcdf, *find_cell_rows(*file.netcdf), file.fields);
}

Points3 mpas_sites(const InputFile& file) { return read_mpas_sites(*file.netcdf); }

Points3 vertex_lines(const InputFile& file) { return read_points(file.path); }

// ---- Fields

FieldFault in_mpas(const MeshField& field) { return find_fault(mpas_names(), field); }
FieldFault in_minimal_mpas(const MeshField& field) {
  return field.location == FieldLocation::edges ? FieldFault::location : in_mpas(field);
}
FieldFault in_ugrid(const MeshField& field) { return find_fault(ugrid_names(true), field); }
FieldFault in_ugrid_triangles(const MeshField& field) {
  return find_fault(ugrid_names(false), field);
}
FieldFault in_scrip(const MeshField& field) { return find_fault(scrip_names(), field); }
FieldFault in_esmf(const MeshField& field) { return find_fault(esmf_names(), field); }
FieldFault in_exodus(const MeshField& field) { return find_fault(exodus_names(), field); }

bool is_any(const std::string& name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

/// What formats for graphics programs compute at Voronoi cells, see is_computed().
bool is_computed_name(const std::string& name) {
  return is_any(name, {"density", "spacing", "quality", "degree"});
}

/// Names in VTK are unique, at whatever location.
FieldFault in_vtk(const MeshField& field) {
  const bool at_cells = field.location == FieldLocation::cells;
  if (field.location == FieldLocation::edges)
    return FieldFault::location;
  if (field.count() > 1)
    return FieldFault::several;
  return is_any(field.name, {"area", "site"}) || (!at_cells && is_computed_name(field.name))
             ? FieldFault::name
             : FieldFault::none;
}

FieldFault in_vtk_cells(const MeshField& field) {
  return field.name == "triangle" ? FieldFault::name : in_vtk(field);
}

FieldFault in_geojson(const MeshField& field) {
  if (field.location != FieldLocation::cells)
    return FieldFault::location;
  if (field.count() > 1)
    return FieldFault::several;
  return is_any(field.name, {"area", "site", "id", "x", "y", "z"}) ? FieldFault::name
                                                                   : FieldFault::none;
}

std::vector<FormatRow> make_table() {
  constexpr Planes flat{.whole = true}, clipped{.clipped = true};
  std::vector<FormatRow> rows{
      {.info = {Format::mpas, "mpas", {".nc"}, "MPAS, complete, with NAME.graph.info", true, true},
       .label = "MPAS",
       .planes = {.clipped = true, .periodic = true},
       .fault = in_mpas,
       .write_mesh = used_up<write_mpas>,
       .polygons_as = Format::mpas,
       .is = is_mpas,
       .read = from_netcdf<read_mpas>,
       .read_sites = mpas_sites},
      {.info = {Format::mpas_minimal,
                "mpas-minimal",
                {".nc"},
                "MPAS, minimal, for MpasMeshConverter.x",
                true,
                true},
       .label = "MPAS",
       .planes = {.periodic = true},
       .fault = in_minimal_mpas,
       .write_mesh = used_up<write_mpas_minimal>},
      {.info = {Format::ugrid, "ugrid", {".nc"}, "UGRID of cells", true, true},
       .label = "UGRID",
       .planes = clipped,
       .fault = in_ugrid,
       .write_mesh = as_grid<write_ugrid>,
       .write_polygons = write_ugrid,
       .is = is_ugrid,
       .read = from_netcdf<read_ugrid>,
       .reads_planes = true},
      {.info =
           {Format::ugrid_triangles, "ugrid-triangles", {".nc"}, "UGRID of triangles", false, true},
       .label = "UGRID",
       .fault = in_ugrid_triangles,
       .write_mesh = to_files<write_ugrid_triangles>},
      {.info = {Format::scrip, "scrip", {".nc"}, "SCRIP", true, true},
       .label = "SCRIP",
       .fault = in_scrip,
       .write_mesh = as_grid<write_scrip>,
       .write_polygons = write_scrip,
       .is = is_scrip,
       .read = from_netcdf<read_scrip>},
      {.info = {Format::esmf, "esmf", {".nc"}, "ESMF", true, true},
       .label = "ESMF",
       .fault = in_esmf,
       .write_mesh = as_grid<write_esmf>,
       .write_polygons = write_esmf,
       .is = is_esmf,
       .read = from_netcdf<read_esmf>},
      {.info = {Format::exodus, "exodus", {".g", ".exo"}, "Exodus of cells", true, true},
       .label = "Exodus",
       .fault = in_exodus,
       .write_mesh = as_grid<write_exodus>,
       .write_polygons = write_exodus,
       .is = is_exodus,
       .read = from_netcdf<read_exodus>},
      {.info = {Format::icon, "", {".nc"}, "ICON", false, true},
       .label = "ICON",
       .is = is_icon,
       .read = from_netcdf<read_icon>},
      {.info = {Format::cf, "", {".nc"}, "cells with bounds (CF, OASIS)", true, true},
       .label = "CF",
       .is = has_cell_rows,
       .read = read_cell_rows_of},
      {.info = {Format::vtp, "vtp", {".vtp"}, "VTK PolyData of triangles"},
       .label = "VTK",
       .planes = flat,
       .fault = in_vtk,
       .write_mesh = to_stream<put_vtp>,
       .polygons_as = Format::vtp_cells,
       .read = from_stream<get_vtk_xml>,
       .reads_planes = true},
      {.info = {Format::vtu, "vtu", {".vtu"}, "VTK UnstructuredGrid of triangles"},
       .label = "VTK",
       .planes = flat,
       .fault = in_vtk,
       .write_mesh = to_stream<put_vtu>,
       .polygons_as = Format::vtu_cells,
       .read = from_stream<get_vtk_xml>,
       .reads_planes = true},
      {.info = {Format::vtp_cells, "vtp-cells", {".vtp"}, "VTK PolyData of cells", true},
       .label = "VTK",
       .planes = clipped,
       .bytes_a_site = 200,
       .fault = in_vtk_cells,
       .write_mesh = to_stream<put_vtp_cells>,
       .write_polygons = polygons_to_stream<put_vtp_cells>},
      {.info = {Format::vtu_cells, "vtu-cells", {".vtu"}, "VTK UnstructuredGrid of cells", true},
       .label = "VTK",
       .planes = clipped,
       .bytes_a_site = 200,
       .fault = in_vtk_cells,
       .write_mesh = to_stream<put_vtu_cells>,
       .write_polygons = polygons_to_stream<put_vtu_cells>},
      {.info = {Format::vtk, "", {".vtk"}, "legacy VTK"},
       .label = "VTK",
       .read = from_stream<get_vtk_legacy>,
       .reads_planes = true},
      {.info = {Format::off, "off", {".off"}, "OFF"},
       .label = "OFF",
       .planes = flat,
       .write_mesh = to_stream<put_off>,
       .write_polygons = polygons_to_stream<put_off>,
       .read = from_stream<get_off>,
       .reads_planes = true},
      {.info = {Format::ply, "ply", {".ply"}, "PLY"},
       .label = "PLY",
       .planes = flat,
       .bytes_a_site = 50,
       .write_mesh = to_stream<put_ply>,
       .write_polygons = polygons_to_stream<put_ply>,
       .read = from_stream<get_ply>,
       .reads_planes = true},
      {.info = {Format::msh, "msh", {".msh"}, "JIGSAW"},
       .label = "MSH",
       .planes = flat,
       .write_mesh = to_stream<put_msh>,
       .read = from_stream<get_msh>,
       .reads_planes = true},
      {.info = {Format::gmsh, "gmsh", {".msh"}, "Gmsh 4.1; 2 and 4 are read"},
       .label = "MSH",
       .planes = flat,
       .holds = {.boundary = true},
       .write_mesh = to_stream<put_gmsh>},
      {.info = {Format::geojson, "geojson", {".geojson"}, "GeoJSON of cells", true},
       .label = "GeoJSON",
       .planes = clipped,
       .bytes_a_site = 600,
       .fault = in_geojson,
       .write_mesh = to_stream<put_geojson>,
       .write_polygons = polygons_to_stream<put_geojson>,
       .read = from_stream<get_geojson>,
       .reads_planes = true},
      {.info = {Format::triangles,
                "triangles",
                {".txt", ".tri"},
                "triangles without points",
                false,
                false,
                true,
                false},
       .label = "triangles",
       .planes = {.whole = true, .clipped = true, .periodic = true},
       .bytes_a_site = 50,
       .write_mesh = to_stream<put_triangles_text>},
      {.info = {Format::mpi_scvt, "mpi-scvt", {std::string(vertices_name)}, "MPI-SCVT"},
       .label = "MPI-SCVT",
       .write_mesh = to_files<write_mpi_scvt>,
       .read = from_files<read_mpi_scvt>,
       .reads_planes = true,
       .read_sites = vertex_lines},
      {.info = {Format::fesom, "fesom", {std::string(fesom_nodes_name)}, "FESOM"},
       .label = "FESOM",
       .write_mesh = to_files<write_fesom>,
       .read = from_files<read_fesom>},
      {.info = {Format::schism, "schism", {".gr3", ".ll"}, "SCHISM"},
       .label = "SCHISM",
       .holds = {.boundary = true, .depth = true},
       .write_mesh = to_files<write_schism>,
       .read = from_stream<get_coastal>},
      {.info = {Format::adcirc, "adcirc", {".14"}, "ADCIRC"},
       .label = "ADCIRC",
       .holds = {.boundary = true, .depth = true},
       .write_mesh = to_files<write_adcirc>,
       .read = from_stream<get_coastal>},
      {.info = {Format::sms, "sms", {".2dm"}, "SMS"},
       .label = "SMS",
       .holds = {.boundary = true, .depth = true},
       .write_mesh = to_stream<put_sms>,
       .read = from_stream<get_sms>}};
  for (FormatRow& row : rows)
    if (row.write_polygons != nullptr)
      row.polygons_as = row.info.format;
  return rows;
}

} // namespace

std::span<const FormatRow> format_table() {
  static const std::vector<FormatRow> table = make_table();
  return table;
}

const FormatRow& find_row(Format format) {
  const std::span<const FormatRow> table = format_table();
  return *std::find_if(table.begin(), table.end(),
                       [&](const FormatRow& row) { return row.info.format == format; });
}

const FormatRow* find_row(const NetcdfReader& file) {
  for (const FormatRow& row : format_table())
    if (row.is != nullptr && row.is(file))
      return &row;
  return nullptr;
}

FieldFault find_fault(Format format, const MeshField& field) {
  const FormatRow& row = find_row(format);
  return row.fault == nullptr ? FieldFault::no_fields : row.fault(field);
}

bool is_computed(Format format, const MeshField& field) {
  const FormatRow& row = find_row(format);
  return !row.info.netcdf && row.fault != nullptr && field.location == FieldLocation::cells &&
         is_computed_name(field.name);
}

namespace {

/// Names of files of the formats that store a field; of those with the name of a path the words.
std::string formats_with(const MeshField& field, const std::string& path) {
  std::vector<std::string> names;
  for (const FormatRow& row : format_table()) {
    if (row.write_mesh == nullptr || row.fault == nullptr || row.fault(field) != FieldFault::none)
      continue;
    const std::string& suffix = row.info.names.front();
    const std::string& name = suffix == suffix_of(path) ? row.info.word : suffix;
    if (std::ranges::find(names, name) == names.end())
      names.push_back(name);
  }
  return listed(names, " or ");
}

std::string location_words(const MeshField& field) {
  return field.location == FieldLocation::cells   ? "cells"
         : field.location == FieldLocation::edges ? "edges"
                                                  : "vertices";
}

} // namespace

void refuse_field(const std::string& path, Format format, const MeshField& field,
                  FieldFault fault) {
  const std::string what = find_row(format).label, others = formats_with(field, path);
  const std::string instead =
      others.empty() ? "leave it out" : message("write {}, or leave it out", others);
  if (fault == FieldFault::name)
    refuse_path(path, "{} has a variable {} of its own; give the field another name", what,
                field.name);
  if (fault == FieldFault::several)
    refuse_path(path,
                "the field {} has several numbers for each of the {}: {}, and {} holds one; choose "
                "an index of each (--at), or write {}",
                field.name, location_words(field), in_words(field.dimensions), what, others);
  if (fault == FieldFault::location)
    refuse_path(path, "{} holds no fields at {}, such as {}; {}", what, location_words(field),
                field.name, instead);
  refuse_path(path, "{} holds no fields; write {}", what, others);
}

std::string triangle_formats(const std::string& last) {
  std::vector<std::string> names;
  for (const FormatRow& row : format_table())
    if (row.planes.whole && row.info.points &&
        std::ranges::find(names, row.info.names[0]) == names.end())
      names.push_back(row.info.names[0]);
  return listed(names, last);
}

std::string polygon_formats(bool on_sphere) {
  std::vector<std::string> words;
  for (const FormatRow& row : format_table())
    if (row.info.cells && row.write_polygons != nullptr && (on_sphere || row.planes.clipped))
      words.push_back(row.info.word);
  return listed(words, " or ");
}

std::string clipped_formats() {
  std::vector<std::string> words;
  for (const FormatRow& row : format_table())
    if (row.info.cells && row.planes.clipped)
      words.push_back(row.info.word);
  return listed(words, " or ");
}

} // namespace calotte::io_detail

void calotte::require_field_format(const std::string& path, Format option) {
  using namespace io_detail;
  const Format format = format_of(path, option);
  if (find_row(format).fault == nullptr)
    refuse_field(path, format, {}, FieldFault::no_fields);
}
