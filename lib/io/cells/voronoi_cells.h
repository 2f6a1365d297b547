// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <optional>
#include <vector>

/// Whether cells are Voronoi cells, and of which mesh.
namespace calotte::io_detail {

/// What polygons are as cells of their centres.
struct ComparedCells {
  NotVoronoi answer = {};
  std::optional<Mesh> mesh = {};       ///< of the centres, unless it is not that of the polygons
  std::optional<Voronoi> voronoi = {}; ///< of the mesh, where the polygons were compared with it
};

/// \param mesh the triangulation that a file gives the centres.
/// \param rounding of the corners.
ComparedCells compare_cells(Mesh mesh, const Polygons& polygons, double rounding);

/// The mesh is what the corners make of the polygons, see mesh_of_cells(). Corners of more than
/// three cells are those of Voronoi cells if they agree with the triangulation of the centres.
/// \param fields as for mesh_of_cells().
/// \pre on the sphere.
ComparedCells compare_cells(Points3 centres, const Polygons& polygons, double rounding,
                            std::vector<MeshField>& fields);

} // namespace calotte::io_detail
