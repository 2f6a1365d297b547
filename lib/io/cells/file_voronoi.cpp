// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "io/cells/open_cells.h"

#include <calotte/mesh_file.h>

#include <utility>

namespace calotte {
namespace {

Voronoi of_polygons(const MeshFile& file) {
  io_detail::OpenCells cells = io_detail::open_cells(file);
  if (!cells.problem.passed())
    base_detail::refuse(base_detail::message(
        "the cells are not Voronoi cells: {}; use areas() and the corners of the polygons",
        cells.problem.text()));
  return std::move(cells.voronoi);
}

} // namespace

Voronoi voronoi(const MeshFile& file) {
  base_detail::require(file.mesh || file.polygons, "the file holds neither a mesh nor cells");
  return file.polygons && !file.is_clipped() ? of_polygons(file) : voronoi(*file.mesh);
}

} // namespace calotte
