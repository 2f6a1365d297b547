// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/mesh_source.h"

#include "io/command.h"
#include "options/format_options.h"
#include "options/point_file.h"
#include "options/sphere_radius_option.h"
#include "text/text.h"

#include <calotte/field_grid.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

namespace calotte::tools {

std::string file_name(const MeshSource& source) {
  return std::filesystem::path(source.path).filename();
}

std::shared_ptr<MeshSource> add_mesh_source(CLI::App& command, const std::string& names) {
  auto source = std::make_shared<MeshSource>();
  command
      .add_option(names, source->path,
                  message("Input mesh: {}; or .txt and .tri", names_of_read_meshes()))
      ->type_name("FILE")
      ->required();
  command.add_option("--points", source->points, "Points to which a .txt or .tri file refers")
      ->type_name("FILE");
  command.add_flag("--lonlat", source->lonlat,
                   "The points of --points are longitude and latitude in degrees");
  return source;
}

namespace {

/// Why points are none of a plane, a clause; "" where z is 0 at all of them.
std::string first_off_plane(const MeshFile& file) {
  for (Eigen::Index i = 0; file.mesh && i < file.mesh->points.cols(); ++i)
    if (file.mesh->points(2, i) != 0)
      return message(": z is not 0 at point {}", i);
  return "";
}

/// Throws for an option that is given, where the mesh is on the other surface.
void refuse_options(const std::vector<const CLI::Option*>& options, const std::string& path,
                    bool plane) {
  const std::array<const char*, 2> surfaces{"sphere", "plane"};
  for (const CLI::Option* option : options)
    if (option->count() > 0)
      refuse(message("{} applies to the {} only, and {} holds a mesh of the {}; leave it out",
                     option->get_name(), surfaces[plane ? 0 : 1], path, surfaces[plane ? 1 : 0]));
}

/// Checks that the mesh is on the surface that the options ask for, and warns of an odd radius.
void require_surface(const MeshSource& source, const MeshFile& file) {
  const std::string& path = source.mesh_path();
  if (file.plane()) {
    refuse_options(source.of_sphere, path, true);
    return;
  }
  if (source.plane)
    refuse_path(path, "it holds no mesh of the plane{}; leave --plane out", first_off_plane(file));
  refuse_options(source.of_plane, path, false);
  if (source.points.empty() && is_netcdf(file))
    warn_of_radius(file.sphere_radius, path);
}

/// The fields of a file without a mesh, on that of --mesh.
MeshFile read_fields_of(const MeshSource& source, FieldChoice choice) {
  FieldGrid grid = read_field_grid(source.path, source.mesh, choice, source.at);
  MeshFile file = std::move(grid.mesh);
  file.fields = std::move(grid.fields);
  file.ignored = std::move(grid.ignored);
  require_surface(source, file);
  return file;
}

} // namespace

MeshFile read_mesh_alone(const MeshSource& source, FieldChoice choice,
                         const std::vector<FieldIndex>& choices) {
  std::optional<Points3> points;
  if (!source.points.empty())
    points = read_point_file(source.points, columns_of(source.plane, source.lonlat)).points;
  MeshFile file =
      calotte::read_mesh_file(source.mesh_path(), points ? &*points : nullptr, choice, choices);
  require_surface(source, file);
  return file;
}

MeshFile read_mesh_file(const MeshSource& source, FieldChoice choice) {
  return choice == FieldChoice::none || source.mesh.empty()
             ? read_mesh_alone(source, choice, source.at)
             : read_fields_of(source, choice);
}

std::string words_of(const std::vector<FieldIndex>& indices) {
  std::string text;
  for (const FieldIndex& index : indices)
    text += message("{}{}={}", text.empty() ? "" : ", ", index.dimension, index.index);
  return text;
}

namespace {

/// The indices of "time=3,lev=0".
std::vector<FieldIndex> parse_indices(const std::string& text) {
  std::vector<FieldIndex> indices;
  for (const std::string& part : split(text, ',')) {
    const std::size_t equals = part.find('=');
    std::int64_t index = 0;
    const char* const end = part.data() + part.size();
    const char* const begin = equals == std::string::npos ? end : part.data() + equals + 1;
    const auto [last, error] = std::from_chars(begin, end, index);
    if (equals == 0 || begin == end || error != std::errc() || last != end)
      refuse(message("--at {}: {} is no index of a dimension; give NAME=INDEX, as in --at "
                     "time=3,lev=0",
                     text, part.empty() ? "\"\"" : part));
    indices.push_back({part.substr(0, equals), index});
  }
  return indices;
}

} // namespace

void add_at(CLI::App& command, std::vector<FieldIndex>& indices) {
  command
      .add_option_function<std::string>(
          "--at", [&indices](const std::string& text) { indices = parse_indices(text); },
          "Indices of times and levels of fields, from 0 on: time=3,lev=0. "
          "-1 is the last. A name may be a part of that of the dimension, in any case, such as lev "
          "of nVertLevels")
      ->type_name("NAME=INDEX,...");
}

void add_fields_of(CLI::App& command, MeshSource& source) {
  command
      .add_option("--mesh", source.mesh,
                  "Mesh of the fields in MESH, if that holds none, as a history")
      ->type_name("FILE");
  add_at(command, source.at);
}

std::optional<double> radius_km(const MeshFile& file, const WidthWords& widths,
                                std::optional<double> metres) {
  if (metres)
    return *metres / metres_per_km;
  if (file.planet_radius)
    return *file.planet_radius / metres_per_km;
  return widths.in_km() ? std::optional(widths.radius) : std::nullopt;
}

const MeshField* find_cell_field(const MeshFile& file, const std::string& name,
                                 std::int64_t cells) {
  const auto found = std::ranges::find_if(file.fields, [&](const MeshField& field) {
    return field.name == name && field.location == FieldLocation::cells &&
           field.values.size() == cells;
  });
  return found == file.fields.end() ? nullptr : &*found;
}

std::string changes_of(const MeshSource& source, const MeshFile& file) {
  std::string lines;
  for (const std::string& change : file.changes)
    lines += message("{}: {}\n", source.path, change);
  return lines;
}

void add_plane(CLI::App& command, MeshSource& source, const std::vector<std::string>& of_sphere,
               const std::vector<std::string>& of_plane) {
  command
      .add_flag("--plane", source.plane,
                "The points of --points are x y on each line. Other files know that their mesh is "
                "planar: .vtp, .vtu, .vtk, .off, .ply or .msh with z = 0, planar MPAS or UGRID")
      ->excludes(command.get_option("--lonlat"));
  for (const std::string& name : of_sphere)
    source.of_sphere.push_back(command.get_option(name));
  for (const std::string& name : of_plane)
    source.of_plane.push_back(command.get_option(name));
}

} // namespace calotte::tools
