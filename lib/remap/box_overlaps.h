// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "remap/box_tiling.h"
#include "remap/room.h"
#include "remap/weight_rows.h"

#include <cstdint>
#include <span>
#include <vector>

namespace calotte::remap_detail {

/// The areas that polygons share with the boxes of a tiling. The boundary of a polygon is cut at
/// meridians and parallels. Each piece adds the area between it and the parallel below to its box,
/// and the area of the strip in each box below to that box, with the sign of its direction (Green's
/// theorem). So the areas of a polygon's parts sum to its own, and those of polygons that tile the
/// sphere to the boxes', whatever their shapes.
class BoxOverlaps {
public:
  explicit BoxOverlaps(const BoxTiling& tiling) : tiling_(tiling) {}

  /// Sets the shared areas, sorted by the number of the box, without those below rounding.
  /// \param corners unit vectors, counter-clockwise.
  /// \returns the area of the polygon.
  double set(std::span<const Vec3> corners, WeightRow& out);

private:
  /// A point of a boundary, and its longitude in degrees, which increases eastwards without bound.
  struct PathPoint {
    MapPoint point;
    double longitude;
  };
  /// A piece of a boundary in one box.
  struct Piece {
    std::int64_t column, row;
    double turn; ///< radians eastwards
    double area; ///< above the parallel below; with the sign of the turn
  };
  /// A column of a window.
  struct Column {
    std::int64_t wrapped;
    double wide; ///< radians
  };

  void set_path(std::span<const Vec3> corners);
  void add_pole(const MapPoint& pole, const MapPoint& before, const MapPoint& after);
  void close_path();
  void trace(const PathPoint& from, const PathPoint& to);
  void trace_monotone(const PathPoint& start, const PathPoint& end);
  void trace_pole(const PathPoint& from, const PathPoint& to);
  void trace_in_column(const PathPoint& start, const PathPoint& end, MapPoint from,
                       const MapPoint& to);
  void add_piece(const MapPoint& from, const MapPoint& to);
  double set_areas(WeightRow& out);
  void put(double area, double whole, std::int32_t box, double box_area, WeightRow& out) const;

  const BoxTiling& tiling_;
  std::vector<PathPoint> path_;
  std::vector<Piece> pieces_;
  std::vector<double> areas_, turns_; ///< by box of a window
  std::vector<double> rises_;         ///< heights of its rows
  std::vector<Column> columns_;
  std::int64_t column_ = 0, row_ = 0; ///< of the last point
  bool contains_south_pole_ = false;
};

} // namespace calotte::remap_detail
