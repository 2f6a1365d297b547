// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/mesh_source.h"

#include "options/format_options.h"
#include "options/point_file.h"
#include "options/sphere_radius_option.h"

namespace calotte::tools {

std::shared_ptr<MeshSource> add_mesh_source(CLI::App& command, const std::string& names) {
  auto source = std::make_shared<MeshSource>();
  command
      .add_option(names, source->path,
                  "Input mesh; .txt and .tri require --points. Names: " +
                      std::string(mesh_suffixes) + ", SaveVertices (MPI-SCVT), or .txt and .tri")
      ->type_name("FILE")
      ->required();
  command.add_option("--points", source->points, "Points to which a .txt or .tri file refers")
      ->type_name("FILE");
  command.add_flag("--lonlat", source->lonlat,
                   "The points of --points are longitude and latitude in degrees");
  return source;
}

MeshFile read_mesh_file(const MeshSource& source, FieldChoice choice) {
  if (source.plane) {
    MeshFile file;
    if (source.points.empty() && is_netcdf_file(source.path)) // has density, fields and cells, too
      file = calotte::read_mesh_file(source.path, nullptr, choice);
    if (!file.plane) // or say why there is none
      file.plane = read_planar_mesh(source);
    return file;
  }
  if (source.points.empty()) {
    MeshFile file = calotte::read_mesh_file(source.path, nullptr, choice);
    if (is_netcdf_file(source.path))
      warn_of_radius(file.sphere_radius, source.path);
    return file;
  }
  const Points3 points = read_point_file(source.points, source.lonlat).points;
  return calotte::read_mesh_file(source.path, &points, choice);
}

std::optional<double> radius_km(const MeshSource& source, const MeshFile& file) {
  constexpr double metres = 1000; // a km
  if (file.sphere_radius == 1 || !is_netcdf_file(source.path))
    return std::nullopt;
  return file.sphere_radius / metres;
}

std::string changes_of(const MeshSource& source, const MeshFile& file) {
  std::string lines;
  for (const std::string& change : file.changes)
    lines += source.path + ": " + change + "\n";
  return lines;
}

Mesh read_mesh(const MeshSource& source) {
  if (source.points.empty())
    return calotte::read_mesh(source.path);
  const Points3 points = read_point_file(source.points, source.lonlat).points;
  return calotte::read_mesh(source.path, &points);
}

CLI::Option* add_plane(CLI::App& command, MeshSource& source) {
  return command
      .add_flag(
          "--plane", source.plane,
          "The mesh is planar. Formats: .vtp, .vtu, .off, .ply or .msh with z = 0, planar MPAS or "
          "UGRID, or .txt and .tri with --points (x y on each line)")
      ->excludes(command.get_option("--lonlat"));
}

PlanarMesh read_planar_mesh(const MeshSource& source) {
  if (source.points.empty())
    return calotte::read_planar_mesh(source.path);
  const Points2 points = read_planar_point_file(source.points).points;
  return calotte::read_planar_mesh(source.path, &points);
}

} // namespace calotte::tools
