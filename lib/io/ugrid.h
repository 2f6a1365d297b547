// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

// The UGRID conventions 1.0 for unstructured grids in NetCDF files. They hold longitudes and
// latitudes, which do not lead back to the last bit of Cartesian coordinates: those of the sites go
// along, and the mesh variable's attribute site_coordinates, which is ours, names them. By it the
// reader knows a file of ours, and by their dimension whether sites are faces or nodes.

namespace calotte::io_detail {

inline constexpr const char* site_coordinates = "site_coordinates";

} // namespace calotte::io_detail
