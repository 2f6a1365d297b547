// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

#include <calotte/voronoi.h>

#include <cstdint>

/// The spacing of cells, and the spacing that a density stands for.
namespace calotte::voronoi_detail {

/// The nominal spacing as nominal_spacing(fields), over the cells that have all their neighbours: a
/// boundary cuts the others. Over all cells with an area if none has all neighbours.
/// \param density by cell, with the maximum 1; empty if it is uniform.
double nominal_spacing(const Voronoi& voronoi, const DoubleVector& density);

/// How the spacing of cells differs from h = nominal density^(-1/4). Both are that of hexagons of a
/// cell's area. The ratios are smoothed over neighbours, in logarithms, which removes the scatter
/// of single cells: a wrong density is wrong over many.
struct SpacingFit {
  double median = 1;        ///< of spacing over h
  double low = 1, high = 1; ///< of 5% of the cells it is less than `low`, of 5% more than `high`
  std::int64_t cells = 0;   ///< with all their neighbours and a density above 0; 0: nothing to tell
};
/// \param density as above. \param nominal in the unit of voronoi; > 0.
SpacingFit spacing_fit(const Voronoi& voronoi, const DoubleVector& density, double nominal);

} // namespace calotte::voronoi_detail
