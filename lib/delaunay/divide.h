// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/regions.h"
#include "delaunay/room.h"

#include <calotte/options.h>

namespace calotte::delaunay_detail {

/// The sphere's regions by the options: centres, owners, and who takes which sites beside its own.
/// A single region has no owners or members listed.
/// \throws Error bad_option.
Regions divide(const Sites& sites, const Partition& partition);

} // namespace calotte::delaunay_detail
