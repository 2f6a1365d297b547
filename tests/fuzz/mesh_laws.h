// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bytes.h"

#include <calotte/check.h>
#include <calotte/mesh_file.h>

namespace calotte::fuzz {

/// What is read is a surface, or polygons whose corners exist.
inline void require_sound(const MeshFile& file) {
  if (file.mesh)
    require(file.mesh->triangles.size() == 0 ||
            (file.mesh->triangles.minCoeff() >= 0 &&
             file.mesh->triangles.maxCoeff() < file.mesh->points.cols()));
  if (file.polygons && file.polygons->ids.items.size() > 0)
    require(file.polygons->ids.items.minCoeff() >= 0 &&
            file.polygons->ids.items.maxCoeff() < file.polygons->corners.cols());
  if (file.mesh)
    check_surface(*file.mesh);
}

} // namespace calotte::fuzz
