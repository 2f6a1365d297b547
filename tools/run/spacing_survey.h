// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <cstdint>

namespace calotte::tools {

/// The spacings at unit columns by a density.
/// \param unit the spacing where the density is 1.
DoubleVector spacings_of(const Density& density, double unit, const Points3& x);

/// The spacings that a density demands of a number of cells, on the unit sphere in radians.
struct SpacingSurvey {
  double unit = 0;                ///< spacing where the density is 1
  double least = 0, greatest = 0; ///< over the sphere or the region
  WidthGradient steepest; ///< of the spacing, radians per radian; of widths, the mean over a cell
};

/// Surveys a density by its values on a lattice of points 0.5 degrees apart, and finer ones around
/// the extremes: features smaller than that may be missed. A regular hexagon of width h has the
/// area sqrt(3)/2 h^2.
///
/// A region is surveyed by as many random points, so that the spacings err by about a hundredth if
/// the density is steep, unless `unit` is given.
/// \param cells > 0, in the region.
/// \param unit the spacing where the density is 1, if it is known; 0 otherwise.
/// \throws Error as evaluate() and random_sphere().
SpacingSurvey survey_spacing(const Density& density, std::int64_t cells, const Surface& region = {},
                             double unit = 0);

} // namespace calotte::tools
