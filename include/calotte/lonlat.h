// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/types.h>

CALOTTE_API_BEGIN
namespace calotte {

/// Unit columns at longitudes and latitudes. They are exact at multiples of 90 degrees and have the
/// same bits on every machine. Longitudes that differ by 360 give the same point, and so do all
/// longitudes at a pole.
/// \param lonlat 2 x n degrees: longitude (any finite value), latitude (-90 to 90).
/// \throws Error invalid_argument unless there are 2 rows, and for a latitude out of range;
///         not_finite; both with the index of the column.
Points3 from_lonlat(const PointsRef& lonlat);

/// Longitude from -180 to 180 and latitude in degrees, 2 x n, within about 1e-15 of 360; at a pole
/// the longitude is 0.
/// \param points 3 x n directions of any norm but 0.
/// \throws Error invalid_argument unless the points have 3 rows.
Points2 to_lonlat(const PointsRef& points);

} // namespace calotte
CALOTTE_API_END
