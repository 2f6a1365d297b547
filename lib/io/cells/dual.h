// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>

#include <cstdint>
#include <optional>
#include <vector>

/// From the cells of a file to the triangulation that is their dual, without a new one.
namespace calotte::io_detail {

/// The triangles of the cells around the corners that three cells surround.
struct Dual {
  Triangles triangles;  ///< one a corner, turned as the polygons are, from the lowest polygon on
  Triangles neighbours; ///< across from each polygon; -1 where the corner there is on the boundary
  Ids corner;           ///< by triangle, in ascending order
  /// The first corner which polygons surround, but not three of them; -1 if there is none.
  std::int64_t failed = -1;
};

/// \param corners the number of corners, which the ids of the polygons refer to.
Dual dual_of(const Polygons& polygons, std::int64_t corners);

/// Whether the vertex of each triangle is its circumcentre, within a distance.
/// \param share of the circumradius, which the distance may be, if that is larger.
/// \param sites directions. \param vertices directions.
/// \param vertex by triangle; empty: those of the same numbers.
bool are_circumcentres(const Points3& sites, const Triangles& triangles, const Points3& vertices,
                       double distance, double share, const Ids& vertex = {});

/// The triangulation of polygons' centres that has a triangle for each corner which three polygons
/// surround, if no other polygons surround a corner, and if these corners are the circumcentres.
/// Without a boundary it is the Delaunay triangulation, and the polygons are the Voronoi cells; an
/// open one is a surface as check_surface() proves. Otherwise none.
/// \param centres moved to the mesh, if there is one.
/// \param polygons counter-clockwise, on the sphere.
/// \param rounding of the corners.
/// \param fields those by corner become fields by triangle, if the mesh is closed.
std::optional<Mesh> mesh_of_cells(Points3& centres, const Polygons& polygons, double rounding,
                                  std::vector<MeshField>& fields);

/// The same triangles in a plane, of centres whose triangulation may have more: those of the hull.
/// The corners need not be circumcentres. none where other than three polygons surround a corner,
/// and without triangles.
std::optional<Mesh> planar_mesh_of_cells(const Points3& centres, const Polygons& polygons);

} // namespace calotte::io_detail
