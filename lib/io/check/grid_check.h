// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/deviations.h"
#include "io/cells/polygons.h"
#include "io/check/room.h"

#include <calotte/mesh_file.h>

#include <cstdint>
#include <string>

/// Compares files of polygons (UGRID, SCRIP, ESMF) with what follows from the polygons.
namespace calotte::io_detail {

void check_ugrid(const MeshFile& file, Deviations& deviations);
void check_scrip(const MeshFile& file, Deviations& deviations);
void check_esmf(const MeshFile& file, Deviations& deviations);

/// Polygons of a file, and the names of its variables.
struct StoredGrid {
  Polygons polygons;
  std::string lists;   ///< name of the lists of corners
  std::string corners; ///< names of the coordinates of the corners; two names in one text
  std::string centres;
  double rounding = 0; ///< of the coordinates, radians
};

/// Checks the orientation; that the sphere is covered once, if no side is open; and that centres
/// are inside. If most corners have the same distance from the centres of all cells around them, as
/// those of Voronoi cells, all must have it; likewise the centres of triangles. Readers have
/// refused cells that overlap.
void check_polygons(const StoredGrid& grid, const Sides& sides, Deviations& deviations);

/// Checks the areas in a variable, if the file has it, in radians^2.
void check_areas(const StoredGrid& grid, const std::string& variable, Deviations& deviations);

/// Checks a mask: its values are 0 and 1, and not all are 0.
void check_mask(const std::string& variable, std::int64_t cells, Deviations& deviations);

/// Checks edge_node_connectivity, face_edge_connectivity, face_face_connectivity and
/// edge_face_connectivity, if a UGRID file has them.
void check_ugrid_connectivity(const Polygons& polygons, const Sides& sides, const std::string& mesh,
                              Deviations& deviations);

} // namespace calotte::io_detail
