// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "grids/room.h"

#include <calotte/density.h>
#include <calotte/matrices.h>
#include <calotte/surface.h>

#include <cstdint>

/// Points to start from beside fixed generators. A descent does not move a free generator past the
/// fixed ones around it. So a free generator that starts among fixed ones that are already as dense
/// as demanded stays there, in a cell far too small.
namespace calotte::grids_detail {

/// Random points that follow a density of sites where fixed generators leave it unmet, see darts.h.
/// \param count number of points; 0 or more.
/// \param cells number of cells that the density demands on the surface, fixed ones included.
/// \param fixed on the sphere of any norm; if there are none, the points are those of
///        random_points().
/// \param sites density of sites, see site_density().
Points3 free_points(std::int64_t count, std::int64_t cells, const Points3& fixed,
                    const Surface& surface, const Density& sites, std::uint64_t seed);

/// The number of cells of a grid with fixed generators: their number, plus the part of `cells`, the
/// number that the density demands without them, that they leave unmet. An estimate from random
/// points.
std::int64_t cells_beside_fixed(const Points3& fixed, std::int64_t cells, const Surface& surface,
                                const Density& sites);

} // namespace calotte::grids_detail
