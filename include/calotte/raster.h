// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/matrices.h>
#include <calotte/mesh.h>

CALOTTE_API_BEGIN
namespace calotte {

/// Values at the nodes of two axes, which may be irregular: of longitudes and latitudes, or of x
/// and y of a plane. Between nodes a value is bilinear in the coordinates of the axes.
///
/// On the sphere it is periodic in longitude. Between the first or last latitude and the pole it is
/// linear; the value at the pole is the mean of that row. The field is continuous on the whole
/// sphere. Outside the grid of a plane, it has the value of the nearest point of the grid.
struct Raster {
  /// nx >= 2, ascending. Degrees east, apart by 1e-9 at least, the last below the first + 360; in a
  /// plane finite, in its unit.
  DoubleVector x = {};
  /// ny >= 2, ascending likewise. Degrees north within -90 to 90; in a plane finite, in its unit.
  DoubleVector y = {};
  DoubleMatrix values = {}; ///< nx x ny; in the unit that the function with the raster states
  bool of_plane = false;    ///< whether the axes are those of a plane. Default: of the sphere.
};

/// The values at n points.
/// \param points 3 x n directions; in a plane 2 x n, or 3 x n with z = 0.
/// \returns n values; NaN next to a node that is NaN.
/// \throws Error invalid_argument if the axes or the shape violate the conditions of Raster, and
///         for another number of rows.
DoubleVector evaluate(const Raster& raster, const PointsRef& points);

} // namespace calotte
CALOTTE_API_END
