// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/delaunay.h"
#include "io/shapes/room.h"

#include <calotte/mesh.h>
#include <calotte/raster.h>

namespace calotte::io_detail {

/// Interpolates widths at points of the sphere linearly on the flat triangles between them, on a
/// grid of longitudes and latitudes: see read_cell_width().
/// \param points 3 x n directions.
/// \param widths n.
/// \throws Error as delaunay(); invalid_argument if the points leave a hemisphere empty.
Raster resampled(const Points3& points, const DoubleVector& widths);

/// The same in a plane, on a grid of x and y that covers the points. Beyond their convex hull the
/// width is that of the nearest point.
/// \param points 2 x n.
/// \throws Error as delaunay().
Raster resampled_in_plane(const Points2& points, const DoubleVector& widths);

} // namespace calotte::io_detail
