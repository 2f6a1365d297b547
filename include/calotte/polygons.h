// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/lists.h>
#include <calotte/matrices.h>
#include <calotte/surface.h>

#include <cstdint>

CALOTTE_API_BEGIN
namespace calotte {

/// n polygons on the sphere, such as the cells of a grid that need not be Voronoi cells. Their
/// sides are arcs of great circles. Or n polygons in a plane, with z = 0. In a direction in which
/// the plane is periodic, the corners of a polygon are the copies nearest to its first corner.
struct Polygons {
  Points3 corners; ///< 3 x m unit columns; in a plane in any unit of length
  IdLists ids;     ///< 0-based corners of each polygon, counter-clockwise seen from outside
  Points3 centres; ///< 3 x n, as the corners; 3 x 0 if the file gives none
  /// Where the corners live. Rings have no effect: the polygons are their own boundary.
  Surface surface = {};

  /// Their number.
  std::int64_t size() const { return ids.size(); }
};

} // namespace calotte
CALOTTE_API_END
