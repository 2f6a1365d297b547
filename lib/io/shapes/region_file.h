// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/written_rings.h"
#include "io/bytes/file_error.h"
#include "io/shapes/room.h"

#include <calotte/surface.h>

#include <iosfwd>
#include <string>

namespace calotte::io_detail {

/// Reads a region of the sphere from a file; see read_region().
Surface read_region_file(const std::string& path);

/// Reads a region of the sphere from a point file of MPAS-Limited-Area; see read_region().
Surface read_region_pts(std::istream& in, const std::string& name);

} // namespace calotte::io_detail
