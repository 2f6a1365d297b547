// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "mesh/room.h"

#include <calotte/types.h>

#include <utility>

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
