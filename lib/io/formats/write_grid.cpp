// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/write_grid.h>

#include "base/require.h"
#include "io/formats/write_mesh.h"

#include <calotte/cut.h>
#include <calotte/mesh_file.h>

#include <utility>

namespace calotte {
namespace {

using base_detail::require;

/// The options with the density of the schedule. \throws Error invalid_argument for a mesh of
/// another run.
WriteOptions options_for(const Mesh& mesh, const Schedule& schedule, const WriteOptions& options) {
  require(mesh.surface == schedule.recipe.surface,
          "the mesh lies on another surface than that of the recipe's run; give the mesh that "
          "make_grid() makes of this recipe");
  WriteOptions all = options;
  all.density = schedule.density;
  all.site_density = {};
  if (schedule.widths && !schedule.widths->of_plane()) {
    constexpr double metres_per_km = 1000;
    all.planet_radius = metres_per_km * schedule.recipe.radius_km;
  }
  return all;
}

bool has_walls(const Recipe& recipe) { return recipe.walls.x || recipe.walls.y; }

GridFile write_with_rings(const std::string& path, const Mesh& mesh, const Recipe& recipe,
                          const WriteOptions& options) {
  require(format_of(path, options.format) == Format::mpas,
          "{}: a limited area is written as MPAS; give a name that ends in .nc", path);
  const CutReport report = write_limited_area(path, mesh, recipe.surface, options);
  return {report.cells, report.cells_by_mask.front(), {0, 0}};
}

GridFile write_between_walls(const std::string& path, const Mesh& mesh, const Recipe& recipe,
                             WriteOptions options) {
  const MeshFile file = walled(mesh, recipe.surface.period(), recipe.walls);
  if (!options.density.uniform()) // by site of the file
    options.site_density =
        evaluate(std::exchange(options.density, {}), file.polygons->centres, mesh.surface);
  write(path, file, options);
  const std::int64_t cells = file.polygons->size();
  return {cells, cells, file.polygons->surface.period()};
}

} // namespace

GridFile write_grid(const std::string& path, const Mesh& mesh, const Recipe& recipe,
                    const Schedule& schedule, const WriteOptions& options) {
  const WriteOptions all = options_for(mesh, schedule, options);
  if (recipe.limited_area)
    return write_with_rings(path, mesh, recipe, all);
  if (has_walls(recipe))
    return write_between_walls(path, mesh, recipe, all);
  GridFile file{mesh.points.cols(), mesh.points.cols(), mesh.surface.period()};
  if (mesh.surface.is_sphere())
    file.coast = io_detail::write_sphere(path, {mesh}, all);
  else
    write(path, mesh, all);
  return file;
}

GridFile write_grid(const std::string& path, Mesh&& mesh, const Recipe& recipe,
                    const Schedule& schedule, const WriteOptions& options) {
  GridFile whole{mesh.points.cols(), mesh.points.cols(), mesh.surface.period()};
  if (recipe.limited_area || has_walls(recipe)) {
    const GridFile part = write_grid(path, std::as_const(mesh), recipe, schedule, options);
    mesh = {};
    return part;
  }
  const WriteOptions all = options_for(mesh, schedule, options);
  if (mesh.surface.is_sphere())
    whole.coast = io_detail::write_sphere(path, {mesh, &mesh}, all);
  else
    write(path, std::move(mesh), all);
  mesh = {};
  return whole;
}

} // namespace calotte
