// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "base/vec3.h"
#include "io/cells/room.h"

#include <calotte/matrices.h>
#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Cells as polygons: their orientation, their areas, and whether they are Voronoi cells.
namespace calotte::io_detail {

/// A side of a polygon that starts from a given corner.
struct Side {
  std::int32_t to;
  std::int32_t polygon;

  bool operator<(const Side& other) const {
    return to < other.to || (to == other.to && polygon < other.polygon);
  }
};

/// The sides of polygons by the corner that they start from, sorted.
struct Sides {
  Lists<Array<Side>, Array<std::int64_t>> from; ///< by corner

  explicit Sides(const Polygons& polygons) : Sides(polygons, polygons.corners.cols()) {}
  /// \param corners their number, where their places are not known.
  Sides(const Polygons& polygons, std::int64_t corners);
  /// The first polygon with a side; -1 if there is none.
  std::int32_t polygon_of(std::int32_t start, std::int32_t to) const;
  /// Whether a side from a corner belongs to one polygon only.
  bool is_open(std::int32_t start) const;
};

/// Polygons from rows of corners, in which consecutive equal ones count once, and -1 is none.
/// \param corners those of polygon i from i * most on.
/// \param places of the corners.
Polygons polygons_of(const std::vector<std::int32_t>& corners, std::int64_t most, Points3 places,
                     Points3 centres);

/// The same polygons without the corners that none of them has.
Polygons with_used_corners(Polygons polygons);

/// Some of the polygons, in the order of their ids, with the corners that they have.
Polygons selected(Polygons polygons, std::span<const std::int32_t> ids);

/// The place of a corner; in a periodic plane of its copy nearest to another corner, the first.
Vec3 copy_near(const Polygons& polygons, std::int32_t first, std::int32_t corner);

/// Areas on the unit sphere in steradians, or in the plane, positive for counter-clockwise
/// polygons. \pre on the sphere each is smaller than a hemisphere.
DoubleVector areas_of(const Polygons& polygons);

/// Turns polygons that run clockwise. \returns how many were turned.
/// \param each they may be of either orientation.
/// \throws Error parse, where both orientations occur; names the first polygon of the rarer one.
std::int64_t turn_counter_clockwise(Polygons& polygons, const std::string& name, bool each);

/// Whether values are the areas of polygons but for rounding.
bool are_areas_of(const Polygons& polygons, const DoubleVector& values);

/// The same polygons with one place for the corners that sides join which are shorter than a
/// billionth of their polygon's width: corners of cocircular sites, an ulp apart.
/// \param areas of the polygons.
Polygons with_merged_corners(Polygons polygons, const DoubleVector& areas);

/// Whether a polygon has a width: its area is more than what the rounding of its corners makes of
/// its perimeter. \param area of the polygon.
bool has_area(const Polygons& polygons, std::int64_t polygon, double area);

/// A fault of polygons as a clause, and the polygon; without one empty.
struct PolygonFault {
  std::string text;
  std::int64_t polygon = -1;
};
/// Where two polygons with an area run through one side in the same direction, or all together are
/// larger than the sphere. \pre counter-clockwise.
PolygonFault overlap_in(const Polygons& polygons);
/// \throws Error parse for such an overlap.
void require_no_overlap(const Polygons& polygons, const std::string& name);

/// The square root of the mean area: of so many cells that cover the sphere, or of polygons.
double mean_width(std::int64_t cells);
double mean_width(const Polygons& polygons);

/// Corners of cells are equal if they are closer: a millionth of the mean cell width, and the
/// rounding of the file.
double corner_tolerance(double mean_width, double rounding);

/// Whether polygons leave less than half of their mean area of the sphere uncovered.
bool cover_sphere(const Polygons& polygons);

/// For each Voronoi vertex the nearest corner of the polygon of one of its cells.
/// \pre the polygons are the Voronoi cells, see not_voronoi().
Ids corners_of_vertices(const Voronoi& voronoi, const Polygons& polygons);

/// The most corners of a polygon.
std::int64_t most_corners(const Polygons& polygons);
/// Corner k of a polygon; past the last one -1, or the last.
std::int32_t corner(const Polygons& polygons, std::int64_t polygon, std::int64_t k);
std::int32_t corner_or_last(const Polygons& polygons, std::int64_t polygon, std::int64_t k);

} // namespace calotte::io_detail
