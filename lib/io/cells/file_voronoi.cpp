// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/open_cells.h"

#include <calotte/error.h>
#include <calotte/mesh_file.h>

#include <utility>

namespace calotte {
namespace {

Voronoi of_polygons(const MeshFile& file) {
  io_detail::OpenCells cells = io_detail::open_cells(file);
  if (!cells.problem.passed())
    throw Error(ErrorCode::invalid_argument,
                "the cells are not Voronoi cells: " + cells.problem.text() +
                    "; use areas() and the corners of the polygons");
  return std::move(cells.voronoi);
}

} // namespace

Voronoi voronoi(const MeshFile& file) {
  if (!file.mesh && !file.polygons)
    throw Error(ErrorCode::invalid_argument, "the file holds neither a mesh nor cells");
  return file.polygons && !file.is_clipped() ? of_polygons(file) : voronoi(*file.mesh);
}

} // namespace calotte
