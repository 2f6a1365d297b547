// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/open_cells.h"

#include <calotte/error.h>
#include <calotte/mesh_file.h>

#include <utility>

namespace calotte {
namespace {

Voronoi of_polygons(const MeshFile& file) {
  io_detail::OpenCells cells = io_detail::open_cells(file);
  if (!cells.problem.empty())
    throw Error(ErrorCode::bad_option, "the cells are not Voronoi cells: " + cells.problem +
                                           "; use areas() and the corners of the polygons");
  return std::move(cells.voronoi);
}

} // namespace

Voronoi voronoi(const MeshFile& file) {
  if (file.plane && file.domain)
    return voronoi(*file.plane, *file.domain);
  if (file.polygons)
    return of_polygons(file);
  if (file.mesh)
    return voronoi(*file.mesh);
  if (file.plane && file.plane->closed())
    return voronoi(*file.plane);
  throw Error(ErrorCode::bad_option,
              "the cells of a bounded plane need its domain, which clips them; give it");
}

} // namespace calotte
