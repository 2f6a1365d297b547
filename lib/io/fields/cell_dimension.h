// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/fields/room.h"

#include <string>
#include <utility>

namespace calotte::io_detail {

/// The name of the dimension of cells in a format of meshes.
/// \param format as in MeshFile.
inline std::string cell_dimension(const std::string& format) {
  using Name = std::pair<const char*, const char*>;
  for (const auto& [part, dimension] :
       {Name("MPAS", "nCells"), Name("SCRIP", "grid_size"), Name("ESMF", "elementCount")})
    if (format.find(part) != std::string::npos)
      return dimension;
  return "cell";
}

} // namespace calotte::io_detail
