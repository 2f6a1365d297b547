// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh_file.h>

namespace calotte::io_detail {

/// The centroids of polygons, for formats that need centres: unit columns, or points of the plane.
/// The centroid of a polygon without area is its first corner.
/// \pre each polygon has corners.
Points3 centroids_of(const Polygons& polygons);

} // namespace calotte::io_detail
