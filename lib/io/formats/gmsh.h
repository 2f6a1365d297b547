// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats/coastal_grid.h"
#include "io/formats/room.h"

#include <iosfwd>
#include <string>

namespace calotte::io_detail {

/// Whether a stream begins as the files of Gmsh do, which have the suffix of JIGSAW's.
bool is_gmsh(std::istream& in);

/// The triangles of a file of Gmsh, and their nodes in the order of the file; the lines between
/// these in the physical groups open, land and island, each as a list of two nodes.
/// \pre is_gmsh(). \throws Error parse that names the line, for text that is no such file; for
/// binary files and version 1; for elements other than triangles, lines and points.
CoastalGrid get_gmsh(std::istream& in, const std::string& name);

} // namespace calotte::io_detail
