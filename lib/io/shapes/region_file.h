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

/// Loops of MPI-SCVT.
/// \param counts of SaveLoopCounts, or null: all points are one loop.
Surface read_region_loops(std::istream& in, const std::string& name, std::istream* counts,
                          const std::string& counts_name);

} // namespace calotte::io_detail
