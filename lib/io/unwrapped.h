// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <calotte/mesh_file.h>

namespace calotte::io_detail {

/// The polygons of a periodic plane in a plane without a period, for formats that have none: each
/// near its centre, or else near its first corner. Corners on both sides of a seam are there twice,
/// the copies after the others.
Polygons unwrapped(Polygons polygons);

} // namespace calotte::io_detail
