// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/open_cells.h"

#include <calotte/mesh_file.h>

namespace calotte {

DoubleVector spacing_density(const MeshFile& file) {
  if (const Mesh* plane = file.plane(); plane && (plane->surface.is_bounded() || plane->closed()))
    return spacing_density(voronoi(*plane));
  if (file.polygons) {
    const io_detail::OpenCells cells = io_detail::open_cells(file);
    return cells.problem.passed() ? spacing_density(cells.voronoi) : DoubleVector();
  }
  if (file.sphere() && file.mesh->closed())
    return spacing_density(voronoi(*file.mesh));
  return {};
}

} // namespace calotte
