// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/connectivity.h"
#include "voronoi/room.h"

#include <calotte/coastal_cells.h>
#include <calotte/voronoi.h>

/// voronoi() in stages, for callers that use the results of a stage while the next runs, and that
/// own the mesh: begun(), connect(), then measure() or its parts.
namespace calotte::voronoi_detail {

/// The centres of cells: unit columns; in a plane with z = 0. \throws Error invalid_argument,
/// naming the first site without a direction, or outside of the plane's box.
Points3 checked_centres(const Mesh& mesh);

struct BegunVoronoi {
  Voronoi voronoi; ///< cells, cells_on_vertex, and where edges_on_cell begin
  Rings rings;
  Triangles neighbours; ///< of the triangles, as in Mesh
};

/// Takes the triangles and their neighbours out of the mesh, which keeps its points.
/// \throws Error invalid_argument, as voronoi(mesh).
BegunVoronoi begun(Mesh& mesh);

/// The cells of a part of a plane or of the sphere, which clips them: `cells`, `vertices` and
/// `vertices_on_cell`.
/// \param joined receives what join_parts() changed, which leaves out vertices. If it is null, a
///        cell of several parts is an error.
/// \pre as bounded(). \throws Error as bounded().
Voronoi clipped_polygons(const Mesh& mesh, CoastChanges* joined = nullptr);

/// The tessellation of these cells. \pre the mesh's surface is such a part.
/// \throws Error invalid_argument, as voronoi(mesh).
Voronoi bounded(const Mesh& mesh);

/// Sets all other ids; frees the rings and the neighbours.
/// \throws Error invalid_argument if two cells share two edges.
void connect(BegunVoronoi& out);

} // namespace calotte::voronoi_detail
