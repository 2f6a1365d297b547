// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/room.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace calotte::density_detail {

/// Ascending values at equal steps, with the interface of Axis.
struct EvenAxis {
  double start = 0, step = 1;
  std::int64_t count = 1; ///< of intervals

  double operator[](std::int64_t i) const { return start + static_cast<double>(i) * step; }
  std::int64_t intervals() const { return count; }
  double fraction(std::int64_t i, double x) const {
    return std::clamp((x - (*this)[i]) / step, 0.0, 1.0);
  }
};

/// A box of x and y: degrees, or of the plane.
struct CoordinateBox {
  double west, dx, south, dy;
};

/// The box that tiles cover, and their numbers.
struct TileBox {
  double west, dx, south, dy; ///< degrees, or of a plane: the first tile's corner, and its size
  std::int32_t columns, rows;
  bool of_plane;
  bool around_x, around_y; ///< whether the last tile of a row, of a column, lies beside the first

  CoordinateBox tile(std::int64_t k) const {
    return {west + static_cast<double>(k % columns) * dx, dx,
            south + static_cast<double>(k / columns) * dy, dy};
  }
  /// Radians per degree, in a plane 1.
  double unit() const { return of_plane ? 1 : std::numbers::pi / 180; }
};

/// The whole sphere in tiles of one degree.
TileBox tiles_of_sphere();

/// The point at x and y in the form of rules and surfaces: a unit vector, or x y 0. \param x, y
/// degrees on the sphere.
Vec3 point_at(double x, double y, bool of_plane);

/// A box's middle, the distance from there to its farthest corner, and its largest extents.
struct Extent {
  Vec3 middle;
  double reach, width, height; ///< radians, or of the plane
};
Extent extent_of(const CoordinateBox& box, bool of_plane);

/// Values at nodes whose density varies: tiles of longitude and latitude, or of x and y, each with
/// its own number of nodes. Between four nodes the values are bilinear.
class WidthTiles {
public:
  /// Intervals of a tile in both directions: powers of two.
  struct Shape {
    std::int32_t columns, rows;
    bool outside = false; ///< the tile is outside the surface
  };

  /// Nodes without values.
  /// \param shapes of the tiles, row by row.
  WidthTiles(const TileBox& box, const std::vector<Shape>& shapes);

  /// A tile, with the interface of RasterField.
  class Tile {
  public:
    const EvenAxis& x() const { return x_; } ///< radians, or x of the plane
    const EvenAxis& y() const { return y_; }
    double value(std::int64_t i, std::int64_t j) const { return values_[j * (x_.count + 1) + i]; }
    double sine(std::int64_t j) const; ///< of the latitude of a row

  private:
    friend WidthTiles;
    EvenAxis x_, y_;
    const double* values_ = nullptr;
  };
  std::int64_t size() const { return static_cast<std::int64_t>(box_.columns) * box_.rows; }
  Tile operator[](std::int64_t tile) const;

  /// The values of a tile, row by row from its south-west corner.
  double* values(std::int64_t tile) { return &values_[static_cast<std::size_t>(at(tile).begin)]; }
  const std::vector<double>& values() const { return values_; } ///< tile by tile
  /// The points of a tile's nodes, in the order of its values: unit vectors, or x y 0.
  std::vector<Vec3> points(std::int64_t tile) const;
  /// The nodes of a tile, as indices of its values, in an order that keeps near ones together.
  std::vector<std::int32_t> near_order(std::int64_t tile) const;
  /// Calls body(x, y, value) for the nodes of a tile; x and y in degrees, or in the plane's unit.
  template <class Body> void for_each_node(std::int64_t tile, const Body& body) {
    const TileNodes nodes = at(tile);
    double* value = values(tile);
    for (std::int32_t j = 0; j <= nodes.rows; ++j)
      for (std::int32_t i = 0; i <= nodes.columns; ++i)
        body(x_of(tile, i), y_of(tile, j), *value++);
  }

  bool lies_outside(std::int64_t tile) const { return outside_[static_cast<std::size_t>(tile)]; }

  /// Makes the interpolated values continuous across tiles: along an edge, the tile with more nodes
  /// takes values that are linear between the nodes of the other. Tiles that lie outside are not
  /// joined.
  void join_edges();

  /// Values at unit vectors, or at points of the plane, given by their coordinates. The bits of a
  /// value depend on its point alone.
  void operator()(const double* x, const double* y, const double* z, std::size_t count,
                  double* values) const;

  bool of_plane() const { return box_.of_plane; }
  const TileBox& box() const { return box_; }

  /// The shapes of tiles and the indices of their first values, by column and row of the box. Each
  /// row has one spare entry at its end, as in WidthTable.
  struct Layout {
    std::vector<std::int32_t> begin, columns, rows;
  };

private:
  struct TileNodes {
    std::int32_t begin, columns, rows;
  };

  TileNodes at(std::int64_t tile) const {
    const auto k = static_cast<std::size_t>(tile + tile / box_.columns);
    return {layout_.begin[k], layout_.columns[k], layout_.rows[k]};
  }
  /// The coordinates of a column and a row of a tile: degrees, or the plane's unit.
  double x_of(std::int64_t tile, std::int32_t i) const {
    return box_.west +
           (static_cast<double>(tile % box_.columns) + static_cast<double>(i) / at(tile).columns) *
               box_.dx;
  }
  double y_of(std::int64_t tile, std::int32_t j) const {
    return box_.south +
           (static_cast<double>(tile / box_.columns) + static_cast<double>(j) / at(tile).rows) *
               box_.dy;
  }
  void join(std::int64_t a, std::int64_t b, bool across);

  TileBox box_;
  Layout layout_;
  std::vector<bool> outside_; ///< by tile
  std::vector<double> values_;
};

} // namespace calotte::density_detail
