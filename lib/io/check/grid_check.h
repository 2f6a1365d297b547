// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/deviations.h"
#include "io/cells/polygons.h"
#include "io/check/room.h"

#include <calotte/mesh_file.h>

#include <cstdint>
#include <string>

/// What files of polygons (UGRID, SCRIP, ESMF) hold against what follows from the polygons.
namespace calotte::io_detail {

void check_ugrid(const MeshFile& file, Deviations& deviations);
void check_scrip(const MeshFile& file, Deviations& deviations);
void check_esmf(const MeshFile& file, Deviations& deviations);

/// Polygons as a file holds them, and the names of its variables.
struct StoredGrid {
  Polygons polygons;
  std::string lists;   ///< of the polygons' corners
  std::string corners; ///< of their places; two names in one text
  std::string centres;
  double rounding = 0; ///< of the places, radians
};

/// Orientation; a sphere covered once, where no side is open; centres inside. Where most corners
/// are as far from the centres of all cells around them, all must be, as those of Voronoi cells
/// are; likewise the centres of triangles. Readers have refused cells that overlap.
void check_polygons(const StoredGrid& grid, const Sides& sides, Deviations& deviations);

/// The areas in a variable, if the file has it, in radians^2.
void check_areas(const StoredGrid& grid, const std::string& variable, Deviations& deviations);

/// 0 and 1, and not 0 everywhere.
void check_mask(const std::string& variable, std::int64_t cells, Deviations& deviations);

/// For edge_node_connectivity, face_edge_connectivity, face_face_connectivity and
/// edge_face_connectivity, where a UGRID file has them.
void check_ugrid_connectivity(const Polygons& polygons, const Sides& sides, const std::string& mesh,
                              Deviations& deviations);

} // namespace calotte::io_detail
