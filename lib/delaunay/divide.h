// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/regions.h"
#include "delaunay/room.h"

#include <calotte/delaunay.h>

namespace calotte::delaunay_detail {

/// Divides sites into regions by the options: centres, owners and members. A single region has no
/// lists of owners and members.
/// \throws Error invalid_argument.
Regions divide(const Sites& sites, const Decomposition& decomposition);

} // namespace calotte::delaunay_detail
