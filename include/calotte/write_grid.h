// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/coastal_cells.h>
#include <calotte/export.h>
#include <calotte/grid.h>
#include <calotte/write.h>

#include <Eigen/Core>

#include <cstdint>
#include <string>

CALOTTE_API_BEGIN
namespace calotte {

/// The result of write_grid().
struct GridFile {
  std::int64_t cells = 0; ///< of the file
  /// The cells whose generators lie in the surface of the recipe: the cells of a limited area
  /// without its rings; else all.
  std::int64_t inside = 0;
  Eigen::Vector2d period{0, 0}; ///< of the file's plane; 0 across walls, and on the sphere
  CoastChanges coast = {};      ///< of cells of a region of the sphere
};

/// Writes the part of a run's mesh that its recipe requests:
///
/// - of a limited area the cells of the region and of the rings around it, see
///   write_limited_area(); an MPAS file;
/// - with walls the cells between them, see walled();
/// - of a region of the sphere, in a format of cells, its coastal_cells();
/// - else the mesh, see write().
///
///     const Schedule schedule = plan(recipe);
///     write_grid("grid.nc", make_grid(schedule).mesh, recipe, schedule);
///
/// \param mesh of make_grid(schedule).
/// \param recipe the request.
/// \param schedule plan(recipe); its density is that of the file.
/// \param options `density` and `site_density` have no effect; fields apply to a mesh that is
///        written whole. The planet of a recipe of widths has their radius.
/// \throws Error as write(), write_limited_area() and walled(); invalid_argument for a mesh of
///         another surface than the schedule's, and for a limited area in another format.
GridFile write_grid(const std::string& path, const Mesh& mesh, const Recipe& recipe,
                    const Schedule& schedule, const WriteOptions& options = {});

/// The same for a mesh that the function may move, with less memory, see write(). The mesh is empty
/// afterwards. If the function throws, the mesh is unchanged or empty.
GridFile write_grid(const std::string& path, Mesh&& mesh, const Recipe& recipe,
                    const Schedule& schedule, const WriteOptions& options = {});

} // namespace calotte
CALOTTE_API_END
