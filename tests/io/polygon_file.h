// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh_file.h>

#include <utility>

namespace calotte::test {

/// A file of cells that are not a mesh's Voronoi cells.
inline MeshFile file_of(Polygons polygons) {
  MeshFile file;
  file.polygons = std::move(polygons);
  file.not_voronoi = {.fault = CellFault::no_tessellation, .detail = "made for a test"};
  return file;
}

} // namespace calotte::test
