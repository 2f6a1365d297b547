// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/plane.h"
#include "view/view_mesh.h"

#include <utility>
#include <vector>

namespace calotte::tools {

void set_plane(ViewMesh& mesh, const Mesh& planar, const Polygons& cells) {
  const Eigen::Index sites = planar.points.cols();
  Polygons triangles{planar.points, {}, {}, planar.surface};
  const Eigen::Index count = planar.triangles.cols();
  triangles.ids.begin.setLinSpaced(count + 1, 0, 3 * count);
  triangles.ids.items = planar.triangles.reshaped();
  triangles = unwrapped(std::move(triangles));
  mesh.triangles = triangles.ids.items.reshaped(3, count);
  mesh.points = triangles.corners;
  mesh.copied.resize(static_cast<std::size_t>(mesh.points.cols() - sites));
  for (Eigen::Index k = 0; k < mesh.triangles.size(); ++k)
    if (const Eigen::Index copy = mesh.triangles(k) - sites; copy >= 0)
      mesh.copied[static_cast<std::size_t>(copy)] = planar.triangles(k);
  mesh.shapes = unwrapped(cells);
}

void set_plane(ViewMesh& mesh, const Mesh& planar) {
  set_plane(mesh, planar, polygons_of(voronoi(planar)));
}

} // namespace calotte::tools
