// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/room.h"
#include "delaunay/sites.h"

#include <calotte/options.h>

#include <cstdint>
#include <vector>

namespace calotte::delaunay_detail {

/// Regions' number by default: a function of the number of sites alone, such that a region's
/// triangulation stays in cache and its halo is a small part of it.
int default_region_count(std::int64_t sites);

/// Centres: those given, or as many as regions are asked for, but no more than sites.
/// \throws Error bad_option (fewer than one region, centres without a direction).
std::vector<Vec3> make_centres(const Sites& sites, const Partition& partition);

} // namespace calotte::delaunay_detail
