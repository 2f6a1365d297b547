// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/types.h>

#include <utility>

namespace calotte::python {

/// The mesh of a plane with two coordinates, as Python has it.
inline PlanarMesh planar(Mesh&& mesh) {
  return {mesh.points.topRows<2>(), std::move(mesh.triangles), std::move(mesh.neighbours),
          std::move(mesh.site_of_input), mesh.surface.period()};
}

/// The same with z = 0. \param surface its plane, with the rings that clip the cells.
inline Mesh spatial(const PlanarMesh& mesh, const Surface& surface) {
  Points3 points = Points3::Zero(3, mesh.points.cols());
  points.topRows<2>() = mesh.points;
  return {std::move(points), mesh.triangles, mesh.neighbours, mesh.site_of_input, surface};
}

} // namespace calotte::python
