// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/planar_mesh.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <string>

/// Meshes of the plane with two rows of coordinates, for tests of the code that has them.
namespace calotte::test {

/// \throws Error bad_option for a mesh of the sphere.
inline PlanarMesh read_planar_mesh(const std::string& path, const Points2* points = nullptr) {
  Points3 places;
  if (points != nullptr)
    places = base_detail::with_z(*points);
  Mesh mesh = read_mesh(path, points != nullptr ? &places : nullptr);
  if (mesh.surface.is_sphere())
    throw Error(ErrorCode::bad_option, path + " holds a mesh of the sphere");
  return mesh_detail::planar(std::move(mesh));
}

} // namespace calotte::test
