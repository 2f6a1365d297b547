// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "remap/room.h"

#include <calotte/remap.h>

#include <cstdint>
#include <vector>

/// The boxes of a raster, completed by outside boxes to a tiling of the sphere, so that each point
/// is in a box.
namespace calotte::remap_detail {

/// The height of a parallel: the sine of its latitude, and 1 minus its magnitude, which keeps its
/// digits near the poles.
struct Height {
  double sine, gap;
};

Height height_of(double latitude); ///< of a latitude in degrees

/// The difference of two heights, upwards.
inline double rise(const Height& from, const Height& to) {
  if (from.sine > 0.5 && to.sine > 0.5)
    return from.gap - to.gap;
  if (from.sine < -0.5 && to.sine < -0.5)
    return to.gap - from.gap;
  return to.sine - from.sine;
}

/// A point of the unit sphere by its meridian and parallel. At a pole it keeps a longitude.
struct MapPoint {
  double east_x, east_y; ///< the unit vector of its longitude
  double radius;         ///< of its parallel, the cosine of its latitude
  Height height;

  Vec3 position() const { return {radius * east_x, radius * east_y, height.sine}; }
  bool at_pole() const { return radius == 0; }
};

/// The MapPoint of a unit vector. A point closer than 1e-15 to a pole becomes the pole, with
/// longitude 0.
MapPoint map_point_of(const Vec3& unit);

/// The angle from one longitude to the other, radians, -pi to pi.
double turn_between(const MapPoint& from, const MapPoint& to);

class BoxTiling {
public:
  /// \throws Error as require_boxes().
  explicit BoxTiling(const LonLatBoxes& boxes);

  std::int64_t columns() const { return std::ssize(column_of_); }
  std::int64_t rows() const { return std::ssize(row_of_); }

  // ---- Columns from west to east; beyond the last column they repeat

  std::int64_t wrapped(std::int64_t column) const {
    if (column >= 0 && column < columns())
      return column;
    const std::int64_t rest = column % columns();
    return rest < 0 ? rest + columns() : rest;
  }
  /// The western meridian of a column in degrees, ascending with the column without bound.
  double west_of(std::int64_t column) const {
    const std::int64_t first = wrapped(column);
    const double west = meridians_[static_cast<std::size_t>(first)];
    return column == first ? west : west + 360.0 * ((column - first) / columns());
  }
  /// The same meridian, as a unit vector of x and y.
  const Vec3& direction_of(std::int64_t column) const {
    return directions_[static_cast<std::size_t>(wrapped(column))];
  }
  /// The column of a longitude in degrees.
  std::int64_t column_at(double longitude) const;

  // ---- Rows from south to north

  const Height& height(std::int64_t row) const { return heights_[static_cast<std::size_t>(row)]; }
  double radius(std::int64_t row) const { return radii_[static_cast<std::size_t>(row)]; }
  std::int64_t row_at(const Height& height) const;

  /// The number of a box in the raster; -1 outside of it.
  std::int32_t box(std::int64_t wrapped_column, std::int64_t row) const {
    const std::int32_t i = column_of_[static_cast<std::size_t>(wrapped_column)],
                       j = row_of_[static_cast<std::size_t>(row)];
    return i < 0 || j < 0 ? -1 : j * width_ + i;
  }
  std::int32_t box_at(const Vec3& unit) const; ///< that of a unit vector

private:
  std::int32_t width_;                  ///< of the raster
  std::vector<double> meridians_;       ///< columns + 1
  std::vector<Vec3> directions_;        ///< by column
  std::vector<Height> heights_;         ///< rows + 1
  std::vector<double> radii_;           ///< rows + 1
  std::vector<std::int32_t> column_of_; ///< of the raster, -1 outside
  std::vector<std::int32_t> row_of_;    ///< of the raster, -1 outside
};

} // namespace calotte::remap_detail
