// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>

#include <cstdint>
#include <optional>
#include <vector>

/// The triangulation that is the dual of the cells of a file, without a new triangulation.
namespace calotte::io_detail {

/// The triangles of cells, one at each corner that three cells surround.
struct Dual {
  Triangles triangles;  ///< one at each corner, oriented like the polygons, from the lowest on
  Triangles neighbours; ///< across from each polygon; -1 if the corner there is on the boundary
  Ids corner;           ///< corner of each triangle, ascending
  /// The first corner that other than three polygons surround; -1 if there is none.
  std::int64_t failed = -1;
};

/// \param corners the number of corners. Ids of the polygons are below it.
Dual make_dual(const Polygons& polygons, std::int64_t corners);

/// Whether the vertex of each triangle is its circumcentre, within a distance.
/// \param share of the circumradius. The larger of it and the distance is the tolerance.
/// \param sites directions.
/// \param vertices directions.
/// \param vertex of each triangle; empty if vertices and triangles have the same numbers.
bool are_circumcentres(const Points3& sites, const Triangles& triangles, const Points3& vertices,
                       double distance, double share, const Ids& vertex = {});

/// The triangulation of the centres of polygons, with one triangle at each corner that three
/// polygons surround. None unless these corners are circumcentres and no other number of polygons
/// surrounds a corner. Without a boundary it is the Delaunay triangulation, and the polygons are
/// the Voronoi cells. An open one is a surface, as check_surface() proves.
/// \param centres moved to the mesh, if there is one.
/// \param polygons counter-clockwise, on the sphere.
/// \param rounding of the corners.
/// \param fields those by corner become fields by triangle, if the mesh is closed.
std::optional<Mesh> mesh_of_cells(Points3& centres, const Polygons& polygons, double rounding,
                                  std::vector<MeshField>& fields);

/// The same in a plane. The triangulation of the centres may have further triangles, near the hull.
/// The corners need not be circumcentres. None if other than three polygons surround a corner, and
/// if there are no triangles.
std::optional<Mesh> planar_mesh_of_cells(const Points3& centres, const Polygons& polygons);

} // namespace calotte::io_detail
