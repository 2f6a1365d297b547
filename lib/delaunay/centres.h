// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/room.h"
#include "delaunay/sites.h"

#include <calotte/delaunay.h>

#include <cstdint>
#include <vector>

namespace calotte::delaunay_detail {

/// The default number of regions: a function of the number of sites alone, chosen so that the
/// triangulation of a region stays in cache and its halo is a small part of it.
int default_region_count(std::int64_t sites);

/// The given centres of the options, or computed ones: as many as the number of regions, but at
/// most one per site.
/// \throws Error invalid_argument (fewer than one region, centres without a direction).
std::vector<Vec3> make_centres(const Sites& sites, const Decomposition& decomposition);

} // namespace calotte::delaunay_detail
