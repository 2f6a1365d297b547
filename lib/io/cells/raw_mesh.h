// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>

#include <string>
#include <vector>

namespace calotte::io_detail {

/// A mesh as a file holds it, before anything is known of its order and orientation.
struct RawMesh {
  Points3 points = {};      ///< the sites; none where the file holds cells without centres
  Triangles triangles = {}; ///< of the sites; none where these are to be triangulated
  bool has_cells = false;   ///< the file has cells of the sites, or else triangles of them
  Polygons polygons = {};   ///< the cells, of either orientation; a cell without corners is unknown
  /// The format leaves the orientation of each cell free, and clockwise ones are turned.
  bool turns_each = false;
  /// How far a corner may be from its place by the file's digits alone, radians.
  double corner_rounding = 0;
  Surface surface = {}; ///< in a plane z is 0; triangles of a periodic one are joined across it
  VertexOrder vertex_order = VertexOrder::after_edges; ///< of an MPAS file
  DoubleVector density = {};                           ///< by site, or empty
  std::vector<MeshField> fields = {};
  Pairs edges = {};                      ///< the sites of the edges that fields have; -1 for none
  std::vector<std::string> ignored = {}; ///< variables that are neither the mesh's nor fields
};

} // namespace calotte::io_detail
