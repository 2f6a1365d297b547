// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/check/room.h"

#include <calotte/mesh_file.h>

#include <string>
#include <vector>

namespace calotte::io_detail {

/// Compares what a file of triangles says of the boundary with its mesh, and with the rules of the
/// model that reads it:
///
/// - lists of nodes (SCHISM, ADCIRC): they follow outer edges, and each outer edge is in one of
///   them, but where dikes are listed. The boundary passes each node once, each node has a
///   triangle, and the stated numbers of listed nodes are theirs. No open list of SCHISM is closed,
///   and land is to the right of lists of ADCIRC.
/// - strings and lines (SMS, Gmsh) follow edges.
/// - flags of coast (FESOM): those other than 0 stand at the nodes of the boundary, if there are
///   any. Each triangle has two neighbours, and each node a triangle.
///
/// \returns nothing for other formats. \throws Error parse, file.
std::vector<Deviation> check_coast(const std::string& path, const MeshFile& file);

} // namespace calotte::io_detail
