// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/written_rings.h"
#include "io/bytes/file_error.h"
#include "io/shapes/room.h"

#include <calotte/surface.h>

#include <iosfwd>
#include <string>

/// Readers of regions of the sphere, one a format; see read_region().
namespace calotte::io_detail {

Surface read_region_geojson(std::istream& in, const std::string& name);

/// Point files of MPAS-Limited-Area.
Surface read_region_pts(std::istream& in, const std::string& name);

} // namespace calotte::io_detail
