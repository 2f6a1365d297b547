// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <optional>
#include <vector>

/// Decides whether cells are Voronoi cells, and of which mesh.
namespace calotte::io_detail {

/// The comparison of polygons with the Voronoi cells of their centres.
struct ComparedCells {
  NotVoronoi answer = {};
  std::optional<Mesh> mesh = {};       ///< of the centres; none if it is not that of the polygons
  std::optional<Voronoi> voronoi = {}; ///< of the mesh, if the polygons were compared with it
};

/// \param mesh the triangulation of the centres in the file.
/// \param rounding of the corners.
ComparedCells compare_cells(Mesh mesh, const Polygons& polygons, double rounding);

/// The mesh follows from the corners of the polygons, see mesh_of_cells(). If more than three cells
/// have a corner, the mesh is the triangulation of the centres, provided that the corners agree
/// with it.
/// \param fields as for mesh_of_cells().
/// \pre on the sphere.
ComparedCells compare_cells(Points3 centres, const Polygons& polygons, double rounding,
                            std::vector<MeshField>& fields);

} // namespace calotte::io_detail
