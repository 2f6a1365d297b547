// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "io/cells/room.h"

#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

namespace calotte::io_detail {

/// A part of a Voronoi tessellation that has a boundary.
struct OpenCells {
  Voronoi voronoi;    ///< whole; its vertices are the corners that the polygons use
  NotVoronoi problem; ///< why the polygons are not such a part
};

/// Converts polygons to Voronoi cells, if their corners are those of Voronoi cells: each corner of
/// three polygons is the circumcentre of their centres, within a millionth of the mean cell width
/// or of its distance from them. Corners on the boundary may be anywhere. The polygons keep their
/// corners.
OpenCells open_cells(const Polygons& polygons);

/// The same for the polygons of a file. Those of the whole sphere were compared with Voronoi cells
/// when they were read; the problem is that of this comparison.
/// \pre the file has polygons.
OpenCells open_cells(const MeshFile& file);

/// The circumcentre of the three cells of a vertex.
Vec3 cell_circumcentre(const Voronoi& cells, Eigen::Index vertex);

} // namespace calotte::io_detail
