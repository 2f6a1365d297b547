// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <calotte/mesh_field.h>
#include <calotte/mesh_file.h>

#include <cstdint>
#include <optional>
#include <vector>

/// From the Voronoi cells of a file to their Delaunay triangulation, without a new one.
namespace calotte::io_detail {

/// The triangles of the cells around the corners.
struct Dual {
  Triangles triangles;  ///< one a corner, turned as the polygons are, from the lowest polygon on
  Triangles neighbours; ///< across from each polygon
  std::int64_t failed =
      -1; ///< the first corner that is not one of three polygons which share sides; -1 if none is
};

/// \param corners the number of corners, which the ids of the polygons refer to.
Dual dual_of(const Polygons& polygons, std::int64_t corners);

/// Whether each vertex is the circumcentre of the triangle of its number, within a distance.
/// \param share of the circumradius, which the distance may be, if that is larger.
/// \param sites directions. \param vertices directions.
bool are_circumcentres(const Points3& sites, const Triangles& triangles, const Points3& vertices,
                       double distance, double share);

/// The Delaunay triangulation of polygons' centres, if it has a triangle for each corner,
/// whose circumcentre the corner is: then the polygons are the Voronoi cells. Otherwise none.
/// \param centres moved to the mesh, if there is one.
/// \param polygons counter-clockwise, on the sphere.
/// \param rounding of the corners.
/// \param fields those by corner become fields by triangle, if there is a mesh.
std::optional<Mesh> mesh_of_cells(Points3& centres, const Polygons& polygons, double rounding,
                                  std::vector<MeshField>& fields);

} // namespace calotte::io_detail
