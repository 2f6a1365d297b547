// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats.h"

namespace calotte::detail {

/// In what a VTK XML file of triangles differs between PolyData (.vtp) and UnstructuredGrid (.vtu).
struct VtkFlavour {
  std::string data_set; ///< the name of the data set's element
  std::string
      cell_counts;   ///< attributes of Piece that count the cells, up to the number of triangles
  std::string cells; ///< the element that holds connectivity and offsets
  bool types;        ///< whether a UInt8 type follows for each cell
};

/// Points Float64 x 3, connectivity and offsets Int64, types 5 (triangle): appended raw blocks,
/// each after its length as UInt64.
void put_vtk(const Sink& sink, const Mesh& mesh, const VtkFlavour& flavour);

/// Reads a file with exactly the head that put_vtk writes. \throws Error parse, file.
Soup get_vtk(std::istream& in, const std::string& name, const VtkFlavour& flavour);

} // namespace calotte::detail
