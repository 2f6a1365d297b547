// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <string>

/// Cells as polygons: their orientation, their areas, and whether they are Voronoi cells.
namespace calotte::io_detail {

/// The cells of a tessellation, which is used up.
Polygons polygons_of(Voronoi&& voronoi);

/// Polygons from a list of corners for each, in which equal corners are one, and consecutive equal
/// ones count once.
/// \param corners 3 x (n * most): those of polygon i from column i * most on; a column of zeros
///        ends the list.
Polygons polygons_of(const Points3& corners, std::int64_t most, Points3 centres);

/// Areas on the unit sphere in steradians, or in the plane, positive for counter-clockwise
/// polygons. \pre on the sphere each is smaller than a hemisphere.
Eigen::VectorXd areas_of(const Polygons& polygons);

/// Turns polygons that run clockwise. \returns how many were turned.
/// \param each they may be of either orientation.
/// \throws Error parse, where both orientations occur; names the first polygon of the rarer one.
std::int64_t turn_counter_clockwise(Polygons& polygons, const std::string& name, bool each);

/// Whether values are the areas of polygons but for rounding.
bool are_areas_of(const Polygons& polygons, const Eigen::VectorXd& values);

/// \throws Error parse, where two polygons run through one side in the same direction, or all
/// together are larger than the sphere. \pre counter-clockwise.
void require_no_overlap(const Polygons& polygons, const std::string& name);

/// Why polygons are not the Voronoi cells of their centres, as a clause that names the first such
/// cell; empty if they are. Corners count as equal if they are closer than a millionth of the mean
/// cell width, and `rounding`.
std::string difference_from(const Voronoi& voronoi, const Polygons& polygons, double rounding);

/// For each Voronoi vertex the nearest corner of the polygon of one of its cells.
/// \pre the polygons are the Voronoi cells, see difference_from().
Ids corners_of_vertices(const Voronoi& voronoi, const Polygons& polygons);

/// The most corners of a polygon.
std::int64_t most_corners(const Polygons& polygons);
/// Corner k of a polygon; past the last one -1, or the last.
std::int32_t corner(const Polygons& polygons, std::int64_t polygon, std::int64_t k);
std::int32_t corner_or_last(const Polygons& polygons, std::int64_t polygon, std::int64_t k);

} // namespace calotte::io_detail
