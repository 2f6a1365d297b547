// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/open_cells.h"

#include <calotte/mesh_file.h>

namespace calotte {

DoubleVector spacing_density(const MeshFile& file) {
  if (file.plane && (file.domain || file.plane->closed()))
    return spacing_density(file.domain ? voronoi(*file.plane, *file.domain) : voronoi(*file.plane));
  if (file.polygons) {
    const io_detail::OpenCells cells = io_detail::open_cells(file);
    return cells.problem.empty() ? spacing_density(cells.voronoi) : DoubleVector();
  }
  if (file.mesh && file.mesh->closed())
    return spacing_density(voronoi(*file.mesh));
  return {};
}

} // namespace calotte
