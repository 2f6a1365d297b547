// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/connectivity.h"
#include "voronoi/room.h"

#include <calotte/voronoi.h>

/// voronoi() in stages, for callers that use the results of a stage while the next runs: begun(),
/// connect(), then measure().
namespace calotte::voronoi_detail {

struct BegunVoronoi {
  Voronoi voronoi; ///< cells, begin and cells_on_vertex
  Rings rings;
};

/// The sites are at these points; the mesh is not copied.
/// \param points as many as the mesh has.
/// \throws Error bad_option, as voronoi(mesh).
BegunVoronoi begun(const Points3& points, const Mesh& mesh);
BegunVoronoi begun(const PlanarMesh& mesh);

/// Sets all other ids.
/// \param mesh the mesh passed to begun().
/// \throws Error bad_option if two cells share two edges.
void connect(const Mesh& mesh, BegunVoronoi& out);
void connect(const PlanarMesh& mesh, BegunVoronoi& out);

} // namespace calotte::voronoi_detail
