// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/raw_mesh.h"
#include "io/command.h"
#include "io/formats/boundary_pieces.h"

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

/// Files of triangles with lists of the nodes of the boundary: SCHISM, ADCIRC, SMS, Gmsh.
namespace calotte::io_detail {

/// A list of nodes as a file has it, in the file's order.
struct NodeList {
  std::int64_t line = 0; ///< of the file, where it starts
  BoundaryKind kind = BoundaryKind::land;
  bool is_barrier =
      false; ///< ADCIRC's: nodes on one side of a dike inside the mesh, or at its edge
  std::vector<std::int32_t> sites = {};
};

/// The lists of a file.
struct NodeLists {
  bool given = false; ///< the file has a part for them
  std::vector<NodeList> lists = {};
  /// The numbers of nodes in all open lists, and in all others, that the file states; -1 for none.
  std::int64_t open_nodes = -1, other_nodes = -1;
};

/// The contents of such a file.
struct CoastalGrid {
  RawMesh raw; ///< with the fields `depth`, and `open` where a list is open
  NodeLists boundary;
};

/// \throws Error parse, naming the line; file.
CoastalGrid get_schism_or_adcirc(std::istream& in, const std::string& name);
CoastalGrid get_sms_grid(std::istream& in, const std::string& name);

/// The lists of nodes of a file that names its format; of other files none.
/// \throws Error parse, file.
NodeLists read_node_lists(const std::string& path);

/// \param depth by site, metres, positive down.
MeshField make_depth_field(const std::vector<double>& depth);
/// 1 for the nodes of open lists. \param nodes their number.
MeshField make_open_field(const NodeLists& boundary, std::int64_t nodes);

} // namespace calotte::io_detail
