// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/connectivity.h"
#include "voronoi/room.h"

#include <calotte/voronoi.h>

/// voronoi() in stages, for those who use a stage's results while the next is made: begun(),
/// connect(), then measure().
namespace calotte::voronoi_detail {

struct BegunVoronoi {
  Voronoi voronoi; ///< cells, begin and cells_on_vertex
  Rings rings;
};

/// The sites stand at these points, without a copy of the mesh. \param points as many as the
/// mesh's. \throws Error bad_option, as voronoi(mesh).
BegunVoronoi begun(const Points3& points, const Mesh& mesh);
BegunVoronoi begun(const PlanarMesh& mesh);

/// Sets all other ids. \param mesh that it was begun with. \throws Error bad_option, where two
/// cells share two edges.
void connect(const Mesh& mesh, BegunVoronoi& out);
void connect(const PlanarMesh& mesh, BegunVoronoi& out);

} // namespace calotte::voronoi_detail
