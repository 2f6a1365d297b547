// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

#include <calotte/density.h>
#include <calotte/voronoi.h>

#include <cstdint>

/// The values of CellFields one by one, for callers that do not store them.
namespace calotte::voronoi_detail {

/// The density at the cells divided by its maximum; empty if it is uniform.
/// \throws Error invalid_argument, as cell_fields().
DoubleVector relative_density(const Voronoi& voronoi, const Density& density);

double spacing_at(const Voronoi& voronoi, std::int64_t cell); ///< CellFields::spacing
double quality_at(const Voronoi& voronoi, std::int64_t cell); ///< CellFields::quality

/// The nominal spacing, see nominal_spacing(fields). \param density empty if it is uniform.
double nominal_spacing(const DoubleVector& area, const DoubleVector& density);

} // namespace calotte::voronoi_detail
