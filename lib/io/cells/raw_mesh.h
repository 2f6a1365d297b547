// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>

#include <string>
#include <vector>

namespace calotte::io_detail {

/// The contents of a mesh file, before its order and orientation are known.
struct RawMesh {
  Points3 points = {};      ///< the sites; none if the file has cells without centres
  Triangles triangles = {}; ///< of the sites; none if the sites are to be triangulated
  bool has_cells = false;   ///< whether the file has cells of the sites; otherwise it has triangles
  Polygons polygons = {};   ///< the cells, of either orientation; unknown cells have no corners
  /// The format does not prescribe an orientation of cells; clockwise ones are reversed.
  bool turns_each = false;
  /// Error of a corner due to the number of digits in the file, in radians.
  double corner_rounding = 0;
  Surface surface = {}; ///< in a plane z is 0; triangles of a periodic one are joined across it
  VertexOrder vertex_order = VertexOrder::after_edges; ///< order of verticesOnCell in an MPAS file
  DoubleVector density = {};                           ///< by site, or empty
  std::vector<MeshField> fields = {};
  Pairs edges = {};                      ///< the sites of the edges that fields have; -1 for none
  std::vector<std::string> ignored = {}; ///< variables that are neither the mesh's nor fields
};

} // namespace calotte::io_detail
