// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "io/cells/room.h"

#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

namespace calotte::io_detail {

/// A part of a Voronoi tessellation that has a boundary.
struct OpenCells {
  Voronoi voronoi;    ///< whole; its vertices are the polygons' corners that are used
  NotVoronoi problem; ///< why polygons are no such part
};

/// Polygons whose corners are those of Voronoi cells: each corner of three polygons is the
/// circumcentre of their centres, within a millionth of the mean cell width or of its distance from
/// them. Other corners may be anywhere, but on the boundary. The polygons keep their corners.
OpenCells open_cells(const Polygons& polygons);

/// The same of a file's polygons. Those of the whole sphere have been compared with Voronoi cells
/// when they were read: the problem is that of the comparison. \pre the file has polygons.
OpenCells open_cells(const MeshFile& file);

/// Of a vertex that has three cells.
Vec3 circumcentre_of(const Voronoi& cells, Eigen::Index vertex);

} // namespace calotte::io_detail
