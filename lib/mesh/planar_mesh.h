// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "mesh/room.h"

#include <calotte/types.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace calotte {

/// A Mesh of the plane with two rows of coordinates, and without the rings that clip its cells.
struct PlanarMesh {
  Points2 points;                          ///< 2 x n sites; in a periodic direction in [0, period)
  Triangles triangles;                     ///< 3 x m site ids, counter-clockwise
  Triangles neighbours;                    ///< 3 x m triangle ids; -1 along an open boundary
  std::vector<std::int32_t> site_of_input; ///< as in Mesh
  Eigen::Vector2d period{0, 0}; ///< of the plane in x and y; 0 in a direction without one

  operator Mesh() const; ///< with z = 0

  /// True if it covers a doubly periodic box; false in a channel, and in a box with land.
  bool closed() const { return period.minCoeff() > 0 && triangles.cols() == 2 * points.cols(); }
};

} // namespace calotte

namespace calotte::mesh_detail {

/// The same mesh with two rows of coordinates. \pre the mesh is one of the plane.
inline PlanarMesh planar(const Mesh& mesh) {
  return {mesh.points.topRows<2>(), mesh.triangles, mesh.neighbours, mesh.site_of_input,
          mesh.surface.period()};
}

/// The same for a mesh that is not used any more.
inline PlanarMesh planar(Mesh&& mesh) {
  return {mesh.points.topRows<2>(), std::move(mesh.triangles), std::move(mesh.neighbours),
          std::move(mesh.site_of_input), mesh.surface.period()};
}

/// The same mesh with z = 0.
/// \param surface its plane, with the rings that clip the cells.
inline Mesh spatial(PlanarMesh&& mesh, Surface surface) {
  Mesh result;
  result.points = base_detail::with_z(mesh.points);
  result.triangles = std::move(mesh.triangles);
  result.neighbours = std::move(mesh.neighbours);
  result.site_of_input = std::move(mesh.site_of_input);
  result.surface = std::move(surface);
  return result;
}

} // namespace calotte::mesh_detail

inline calotte::PlanarMesh::operator Mesh() const {
  return mesh_detail::spatial(PlanarMesh(*this),
                              period.maxCoeff() > 0 ? Surface::periodic(period) : Surface::plane());
}
