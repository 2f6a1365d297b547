// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"
#include "draw/shapes.h"

#include <numeric>
#include <string>
#include <utility>
#include <vector>

/// Parts of the pictures of meshes of the plane.
namespace calotte::tools {

/// Whether the plane is periodic in a direction, and the mesh has a boundary.
inline bool has_walls(const Mesh& mesh) {
  return mesh.surface.period().maxCoeff() > 0 && !mesh.closed();
}

/// The part of the plane that the cells of such a mesh fill, as far as the window and two periods
/// beyond it: its rings are the sides that belong to one cell. All of the plane for a box with
/// walls along a period.
Surface walls_of(const Polygons& cells);

/// Sets the part of the plane that clips the cells of a mesh.
/// \throws Error invalid_argument for a domain with another period.
void set_domain(Mesh& mesh, const Surface& domain);

/// The visible part of the plane.
struct Window {
  Eigen::Vector2d low, high;

  Eigen::Vector2d middle() const { return low + (high - low) / 2; }
  Eigen::Vector2d extent() const { return high - low; }
};

/// The box of a periodic mesh, otherwise its part of the plane or its sites with a margin.
/// \param part the mesh's surface, or its walls.
Window window_of(const Mesh& mesh, const Surface& part);

/// The mesh to draw, or a larger one that contains it.
struct Drawn {
  Mesh mesh;
  std::vector<std::int32_t> site; ///< of each of its points, or -1

  explicit Drawn(Mesh from)
      : mesh(std::move(from)), site(static_cast<std::size_t>(mesh.points.cols())) {
    std::iota(site.begin(), site.end(), 0);
  }
};

/// The mesh, with the sites beyond it that close the cells in the window. Triangles without a
/// period need no further sites.
Drawn drawn_of(const Mesh& mesh, Shapes shapes, const Window& window);

Scene scene_of(const Drawn& drawn, Shapes shapes, const Window& window);

/// The values of a list for the sites, for each place; true for a far site. Empty if that is.
std::vector<bool> by_place(const Drawn& drawn, const std::vector<bool>& by_site);

/// The values of the mesh's own cells, in the unit of the mesh.
/// \param clipped by site, the cells at the boundary for Colouring::valence; otherwise empty.
/// \param part whose rings clip the cells; \param scene of cells.
std::vector<double> values_of_cells(const Mesh& mesh, const DrawOptions& options,
                                    const Surface& part, const std::vector<bool>& clipped,
                                    const Scene& scene, const Window& window);

/// The values of the scene's triangles, in the unit of the mesh.
std::vector<double> values_of_triangles(const Mesh& mesh, const DrawOptions& options,
                                        const std::vector<bool>& clipped, const Drawn& drawn,
                                        const Scene& scene, const Window& window);

/// The picture of a mesh of the plane. \pre the path and the options are checked.
void draw_plane(const std::string& path, const Mesh& mesh, const DrawOptions& options);

} // namespace calotte::tools
