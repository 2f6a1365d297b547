// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <cstdint>

namespace calotte::tools {

/// The spacings by a density at points of a surface.
/// \param unit the spacing where the density is 1.
DoubleVector spacings_of(const Density& density, double unit, const Points3& x,
                         const Surface& surface = {});

/// The spacings that a density demands of a number of cells, on the unit sphere in radians, in a
/// plane in its unit.
struct SpacingSurvey {
  double unit = 0;                ///< spacing where the density is 1
  double least = 0, greatest = 0; ///< over the surface
  /// Of the spacing, as a share of the distance; of widths, the mean over a cell. In a plane x and
  /// y stand for longitude and latitude.
  WidthGradient steepest;
};

/// Surveys a density by its values on a lattice of points 0.5 degrees apart, and finer ones around
/// the extremes: features smaller than that may be missed. A regular hexagon of width h has the
/// area sqrt(3)/2 h^2.
///
/// A region and a plane are surveyed by as many random points, so that the spacings err by about a
/// hundredth if the density is steep, unless `unit` is given.
/// \param cells > 0, on the surface.
/// \param unit the spacing where the density is 1, if it is known; 0 otherwise.
/// \throws Error as evaluate() and random_points().
SpacingSurvey survey_spacing(const Density& density, std::int64_t cells,
                             const Surface& surface = {}, double unit = 0);

} // namespace calotte::tools
