// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"
#include "draw/shapes.h"

#include <optional>
#include <vector>

/// Parts of the pictures of meshes of the plane.
namespace calotte::tools {

/// Whether the plane is periodic in a direction, and the mesh has a boundary.
inline bool has_walls(const PlanarMesh& mesh) {
  return mesh.period.maxCoeff() > 0 && !mesh.closed();
}

/// The domain that the cells of such a mesh fill, as far as the window and two periods beyond it:
/// its rings are the sides that belong to one cell. None for a box with walls along a period.
std::optional<PlanarDomain> walls_of(const Polygons& cells);

/// The visible part of the plane.
struct Window {
  Eigen::Vector2d low, high;

  Eigen::Vector2d middle() const { return low + (high - low) / 2; }
  Eigen::Vector2d extent() const { return high - low; }
};

/// The box of a periodic mesh, otherwise the domain or the sites with a margin.
Window window_of(const PlanarMesh& mesh, const std::optional<PlanarDomain>& domain);

/// The mesh to draw, or a larger one that contains it.
struct Drawn {
  Mesh mesh; ///< triangles and neighbours
  Points2 places;
  std::vector<std::int32_t> site; ///< of each place, or -1

  explicit Drawn(const PlanarMesh& from)
      : mesh{{}, from.triangles, from.neighbours, {}}, places(from.points),
        site(static_cast<std::size_t>(from.points.cols())) {
    for (std::size_t i = 0; i < site.size(); ++i) {
      site[i] = static_cast<std::int32_t>(i);
    }
  }
};

/// The mesh, with the sites beyond it that close the cells in the window. Triangles without a
/// period need no further sites.
Drawn drawn_of(const PlanarMesh& mesh, Shapes shapes, const Window& window);

Scene scene_of(const Drawn& drawn, Shapes shapes, const Window& window);

/// The values of a list for the sites, for each place; true for a far site. Empty if that is.
std::vector<bool> by_place(const Drawn& drawn, const std::vector<bool>& by_site);

/// The values of the mesh's own cells, in the unit of the mesh.
/// \param clipped by site, the cells at the boundary for Colouring::valence; otherwise empty.
/// \param scene of cells.
std::vector<double> values_of_cells(const PlanarMesh& mesh, const DrawOptions& options,
                                    const std::optional<PlanarDomain>& domain,
                                    const std::vector<bool>& clipped, const Scene& scene,
                                    const Window& window);

/// The values of the scene's triangles, in the unit of the mesh.
std::vector<double> values_of_triangles(const PlanarMesh& mesh, const DrawOptions& options,
                                        const std::vector<bool>& clipped, const Drawn& drawn,
                                        const Scene& scene, const Window& window);

} // namespace calotte::tools
