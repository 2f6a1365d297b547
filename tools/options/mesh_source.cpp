// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/mesh_source.h"

#include "options/format_options.h"
#include "options/point_file.h"
#include "options/sphere_radius_option.h"

#include <calotte/error.h>
#include <calotte/voronoi.h>

#include <set>
#include <utility>
#include <vector>

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

namespace {

/// For each corner of polygons the next one along their boundary, -1 elsewhere; none if several
/// boundaries pass a corner.
std::optional<std::vector<std::int32_t>> boundary_of(const Polygons& polygons) {
  std::set<std::pair<std::int32_t, std::int32_t>> sides;
  const auto for_each_side = [&](const auto& body) {
    for (std::int64_t i = 0; i < polygons.size(); ++i)
      for (std::int64_t k = polygons.begin[i], end = polygons.begin[i + 1]; k != end; ++k)
        body(polygons.ids[k], polygons.ids[k + 1 == end ? polygons.begin[i] : k + 1]);
  };
  for_each_side([&](std::int32_t from, std::int32_t to) { sides.insert({from, to}); });
  std::vector<std::int32_t> next(static_cast<std::size_t>(polygons.corners.cols()), -1);
  bool simple = true;
  for_each_side([&](std::int32_t from, std::int32_t to) {
    if (sides.contains({to, from}))
      return;
    std::int32_t& after = next[static_cast<std::size_t>(from)];
    simple = simple && after < 0;
    after = to;
  });
  return simple ? std::optional(std::move(next)) : std::nullopt;
}

/// Whether the file's cells are the Voronoi cells that a domain clips.
bool clips_to_cells(const PlanarDomain& domain, const MeshFile& file) {
  constexpr double rounding = 1e-6;
  if (domain.rings.empty())
    return false;
  try {
    const Eigen::VectorXd clipped = voronoi(*file.plane, domain).cell_area,
                          own = areas(*file.polygons);
    return clipped.size() == own.size() &&
           ((clipped - own).array().abs() <= rounding * own.array()).all();
  } catch (const Error&) { // a cell in several parts, for example
    return false;
  }
}

} // namespace

std::optional<PlanarDomain> domain_of_cells(const MeshFile& file) {
  if (!file.plane || !file.polygons || file.plane->period.maxCoeff() > 0)
    return std::nullopt;
  std::optional<std::vector<std::int32_t>> next = boundary_of(*file.polygons);
  if (!next)
    return std::nullopt;
  PlanarDomain domain;
  for (std::size_t start = 0; start < next->size(); ++start) {
    std::vector<std::int32_t> ring;
    for (auto at = static_cast<std::int32_t>(start); (*next)[static_cast<std::size_t>(at)] >= 0;) {
      ring.push_back(at);
      at = std::exchange((*next)[static_cast<std::size_t>(at)], -1);
    }
    if (ring.empty())
      continue;
    domain.rings.emplace_back(2, std::ssize(ring));
    for (std::size_t k = 0; k < ring.size(); ++k)
      domain.rings.back().col(static_cast<Eigen::Index>(k)) =
          file.polygons->corners.col(ring[k]).head<2>();
  }
  return clips_to_cells(domain, file) ? std::optional(std::move(domain)) : std::nullopt;
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
