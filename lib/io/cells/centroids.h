// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh_file.h>

namespace calotte::io_detail {

/// The centroids of polygons, for formats that need centres: unit columns, or places of the plane.
/// That of a polygon without area is its first corner. \pre each has corners.
Points3 centroids_of(const Polygons& polygons);

} // namespace calotte::io_detail
