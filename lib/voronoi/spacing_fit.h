// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voronoi/room.h"

#include <calotte/voronoi.h>

#include <cstdint>

/// The spacing of cells, compared with the spacing that a density prescribes.
namespace calotte::voronoi_detail {

/// The nominal spacing, see nominal_spacing(fields), over the cells that have all their neighbours,
/// as a boundary cuts the others. If there are none, over all cells with an area.
/// \param density by cell, with the maximum 1; empty if it is uniform.
double nominal_spacing(const Voronoi& voronoi, const DoubleVector& density);

/// The ratios of the spacing of cells to h = nominal density^(-1/4). The spacing is that of a
/// hexagon of the cell's area. The logarithms of the ratios are smoothed over neighbours, which
/// removes the scatter of single cells: a wrong density is wrong over many cells.
struct SpacingFit {
  double median = 1;        ///< of the spacing over h
  double low = 1, high = 1; ///< 5% and 95% quantiles of the ratio
  std::int64_t cells = 0;   ///< cells compared: with all neighbours, density > 0
};
/// \param density as above. \param nominal in the unit of voronoi; > 0.
SpacingFit spacing_fit(const Voronoi& voronoi, const DoubleVector& density, double nominal);

/// The logarithms of the spacings of cells, smoothed over their neighbours. The spacing is that of
/// a hexagon of the cell's area. \param passes of smoothing. Each adds half a spacing squared to
/// the variance of the weight. \returns by cell; NaN for cells that lack a neighbour.
DoubleVector smoothed_log_spacings(const Voronoi& voronoi, int passes);

} // namespace calotte::voronoi_detail
