// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/written_rings.h"
#include "io/netcdf/netcdf_reader.h"
#include "io/shapes/room.h"

#include <calotte/ocean.h>

#include <vector>

/// Readers of coasts, one a format; see read_coast().
namespace calotte::io_detail {

/// Adds the land to the left of rings. Rings of fewer than three corners have no area and are
/// ignored.
void add_land(const std::vector<WrittenRing>& rings, Coast& coast);

/// The land of a binned file of GSHHG: level 1, Antarctica with its ice shelves.
/// \throws Error parse.
Coast read_gshhg(const NetcdfReader& file);

} // namespace calotte::io_detail
