// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/matrices.h>
#include <calotte/surface.h>

#include <optional>

CALOTTE_API_BEGIN
namespace calotte {

/// Where cells end at the edge of a set of points.
enum class EdgeCells {
  whole, ///< nowhere: Voronoi cells, which may reach far into the open
  hull,  ///< at the convex hull of the points; on the sphere if they lie in a hemisphere
  /// Half way to the neighbours, mirrored at their point, where the open reaches it: as far from it
  /// as on the other side. In a lattice a cell at the edge is as large as one inside. Open are the
  /// outside of the hull, and triangles whose circumcircle is more than `gap` times as wide as the
  /// narrowest one around each of their points.
  neighbours,
  reach, ///< all cells at the distance `reach` from their points
};

/// Options of area_weights().
struct AreaWeightOptions {
  /// Default: whole where the points surround the sphere or fill a periodic box, and in a part that
  /// rings bound; else neighbours.
  std::optional<EdgeCells> edge = {};
  double reach = 0; ///< with EdgeCells::reach: more than 0; an angle of at most pi/2, or a length
  double gap = 4;   ///< with EdgeCells::neighbours: 1 or more
  /// As DelaunayOptions::merge_within: points this near share a cell. Default 0: equal ones do.
  double merge_within = 0;
};

/// The area of each point's Voronoi cell, such as weights of the nodes of a mean or of a loss
/// function. Equal points share their cell in equal parts. The weights sum to the area that the
/// cells cover, 4 pi of the whole sphere, within 1e-13. Time: that of triangulate(), and where many
/// cells end at the edge as much again.
///
///     const DoubleVector weights = area_weights(points);  // steradians
///
/// \param points as for triangulate(), with duplicates and in any order.
/// \param surface where the points live; its rings bound the cells. Default: the sphere.
/// \returns one weight for each point: steradians, in a plane the square of its unit.
/// \throws Error as triangulate(), in a part that rings bound as voronoi(); invalid_argument for an
///         option out of range, for an edge in a part that rings bound, for whole cells in a
///         plane without an end, for a hull in a channel, and with the index of the point where
///         points are so near, as 1e-60, that areas are no numbers.
DoubleVector area_weights(const PointsRef& points, const Surface& surface = {},
                          const AreaWeightOptions& options = {});

} // namespace calotte
CALOTTE_API_END
