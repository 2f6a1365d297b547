// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
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
  Lists<Array<Side>, Array<std::int64_t>> from; ///< sides that start at each corner

  explicit Sides(const Polygons& polygons) : Sides(polygons, polygons.corners.cols()) {}
  /// \param corners the number of corners, if their coordinates are not known.
  Sides(const Polygons& polygons, std::int64_t corners);
  /// The first polygon with a side; -1 if there is none.
  std::int32_t polygon_of(std::int32_t start, std::int32_t to) const;
  /// Whether a side from a corner belongs to one polygon only.
  bool is_open(std::int32_t start) const;
};

/// Polygons from rows of corners. Consecutive equal corners count once, and -1 is padding.
/// \param corners polygon i has those from i * most on.
/// \param points coordinates of the corners.
Polygons make_polygons(const std::vector<std::int32_t>& corners, std::int64_t most, Points3 points,
                       Points3 centres);

/// Removes the corners that no polygon uses.
Polygons with_used_corners(Polygons polygons);

/// Selects polygons, in the order of the ids, with the corners that they use.
Polygons selected(Polygons polygons, std::span<const std::int32_t> ids);

/// The position of a corner; in a periodic plane, that of its copy nearest to the corner `first`.
Vec3 copy_near(const Polygons& polygons, std::int32_t first, std::int32_t corner);

/// Areas: steradians on the unit sphere, or those of the plane; positive for counter-clockwise
/// polygons.
/// \pre on the sphere each polygon is smaller than a hemisphere.
DoubleVector areas_of(const Polygons& polygons);

/// Reverses clockwise polygons. \returns how many were reversed.
/// \param each polygons may have different orientations.
/// \throws Error parse, if both orientations occur and `each` is false; names the first polygon of
/// the rarer one.
std::int64_t turn_counter_clockwise(Polygons& polygons, const std::string& name, bool each);

/// Whether values are the areas of polygons, up to rounding.
bool are_areas_of(const Polygons& polygons, const DoubleVector& values);

/// Merges corners that are joined by sides shorter than a billionth of the width of their polygon,
/// as those of cocircular sites, which are an ulp apart.
/// \param areas of the polygons.
Polygons with_merged_corners(Polygons polygons, const DoubleVector& areas);

/// Whether the area of a polygon is larger than the rounding of its corners along its perimeter.
/// \param area of the polygon.
bool has_area(const Polygons& polygons, std::int64_t polygon, double area);

/// A fault of polygons, as a clause for messages, and the polygon; empty without a fault.
struct PolygonFault {
  std::string text;
  std::int64_t polygon = -1;
};
/// Finds polygons that overlap: two polygons with an area have a side in the same direction, or all
/// together are larger than the sphere.
/// \pre counter-clockwise.
PolygonFault overlap_in(const Polygons& polygons);
/// \throws Error parse if polygons overlap.
void require_no_overlap(const Polygons& polygons, const std::string& name);

/// The square root of the mean area, of so many cells that cover the sphere, or of polygons.
double mean_width(std::int64_t cells);
double mean_width(const Polygons& polygons);

/// The distance below which corners of cells are equal: a millionth of the mean cell width, plus
/// the rounding in the file.
double corner_tolerance(double mean_width, double rounding);

/// Whether polygons cover the sphere: less than half of their mean area is uncovered.
bool cover_sphere(const Polygons& polygons);

/// For each Voronoi vertex, the nearest corner of one of the polygons of its cells.
/// \pre the polygons are the Voronoi cells, see not_voronoi().
Ids corners_of_vertices(const Voronoi& voronoi, const Polygons& polygons);

/// Maximum number of corners of a polygon.
std::int64_t most_corners(const Polygons& polygons);
/// Corner k of a polygon; past the last one -1, or the last.
std::int32_t corner(const Polygons& polygons, std::int64_t polygon, std::int64_t k);
std::int32_t corner_or_last(const Polygons& polygons, std::int64_t polygon, std::int64_t k);

} // namespace calotte::io_detail
