// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf_reader.h"
#include "io/region_file.h"
#include "io/room.h"

#include <calotte/ocean.h>

/// Readers of coasts, one a format; see read_coast().
namespace calotte::io_detail {

/// Adds a ring, turned so that its smaller side is to its left, or to its right for a hole. A ring
/// of fewer than three corners has no area and is left out.
void add_ring(SphericalRing ring, bool hole, Coast& coast);

/// The land of a binned file of GSHHG: level 1, Antarctica with its ice shelves.
/// \throws Error parse.
Coast read_gshhg(const NetcdfReader& file);

} // namespace calotte::io_detail
