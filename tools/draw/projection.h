// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

/// The projections, as policies of the templates that make pictures. Each takes directions of a
/// scene (unit; x to the right, y up, z to the viewer of the map's middle) to points of a map,
/// whose unit is a radian at its middle, and knows
///   half_width, half_height  the map reaches from minus these to these
///   period                   of u, 0 where it has none
///   project(p)               of any direction that the map shows
///   tangents(p)              how p turns as u and v grow
///   shows(p), shows_some(c)  whether a point, or any part of a convex polygon, is on the map
///   may_show(c, window)      false where a polygon is known to be outside a window
///   height(corners)          1 where a shape is seen from above, 0 where from the side
///   clipped(corners)         the part of a convex polygon that is on the map
///   direction(point, p)      the direction at a point; false where there is none
///   bounds(facet)            a part of the map outside of which the facet is not
///   Rays                     the directions of the samples of an image of a window
namespace calotte::tools {

using Eigen::Vector3d;

/// Coordinates on a map: u to the right, v up.
struct MapPoint {
  double u = 0, v = 0;
};

/// The derivatives of a direction by u and v.
struct Tangents {
  Vector3d across, up;
};

struct Bounds {
  double left = 0, right = 0, bottom = 0, top = 0;
};

/// A spherical triangle with great-circle sides, counter-clockwise.
struct Facet {
  Vector3d a, b, c;

  /// Square of its longest chord, L^2. The facet's points are p/|p| for p in the flat triangle,
  /// where |p|^2 >= 1 - L^2/3.
  double longest() const {
    return std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
  }
};

/// The part of a map that a picture shows: all of it, or an enlarged rectangle.
struct MapWindow {
  Projection projection = Projection::globe;
  double zoom = 1;   ///< >= 1; the window is this much smaller than the map in both directions
  double middle = 0; ///< v at its middle; u is 0 there

  MapWindow() = default;
  MapWindow(Projection map) : projection(map) {} // the whole map
  MapWindow(Projection map, double enlargement, double middle_v)
      : projection(map), zoom(enlargement), middle(middle_v) {}

  bool whole() const { return zoom == 1; }
  template <class Map> double half_width() const { return Map::half_width / zoom; }
  template <class Map> double half_height() const { return Map::half_height / zoom; }
  /// Pixels per unit of the map, for a picture of this width.
  template <class Map> double scale(double width) const {
    return width / (2 * Map::half_width) * zoom;
  }
};

/// u or v of the middle of a sample, for a number of samples that fill a map.
inline double middle_of(int sample, int samples, double half) {
  return ((2 * sample + 1.0) / samples - 1) * half;
}

/// Where the arc between a direction before the limb and one behind it crosses the limb, z = 0.
Vector3d limb_between(const Vector3d& a, const Vector3d& b);

struct Orthographic {
  static constexpr double half_width = 1;
  static constexpr double half_height = 1;
  static constexpr double period = 0;

  static MapPoint project(const Vector3d& p) { return {p.x(), p.y()}; }
  static Tangents tangents(const Vector3d& p) {
    return {{1, 0, -p.x() / p.z()}, {0, 1, -p.y() / p.z()}};
  }
  static bool shows(const Vector3d& p) { return p.z() >= 0; }
  /// An arc between two corners behind the limb stays behind it, and so does a shape.
  static bool shows_some(const std::vector<Vector3d>& corners) {
    return std::any_of(corners.begin(), corners.end(), [](const Vector3d& p) { return p.z() > 0; });
  }
  /// False if a convex polygon is known to lie beyond one side of the window. x and y of a point
  /// inside it are at least as far out as those of the corners.
  static bool may_show(const std::vector<Vector3d>& corners, const MapWindow& window);
  static double height(const std::vector<Vector3d>& corners);
  static std::vector<Vector3d> clipped(const std::vector<Vector3d>& polygon);
  static Bounds bounds(const Facet& facet);
  /// A point of the map. False where it is beyond the limb.
  static bool direction(const MapPoint& point, Vector3d& p);

  class Rays {
  public:
    Rays(int columns, int rows, const MapWindow& window = {})
        : columns_(columns), rows_(rows), half_(window.half_width<Orthographic>()) {}
    /// False where the sample is not on the map.
    bool at(int row, int column, Vector3d& p) const {
      const double x = middle_of(column, columns_, half_);
      const double y = -middle_of(row, rows_, half_);
      const double z2 = 1 - x * x - y * y;
      if (z2 <= 0) {
        return false;
      }
      p = {x, y, std::sqrt(z2)};
      return true;
    }

  private:
    int columns_, rows_;
    double half_; ///< of the window's width and height
  };
};

struct PlateCarree {
  static constexpr double half_width = std::numbers::pi;
  static constexpr double half_height = std::numbers::pi / 2;
  static constexpr double period = 2 * std::numbers::pi;

  static MapPoint project(const Vector3d& p) {
    return {std::atan2(p.x(), p.z()), std::atan2(p.y(), std::hypot(p.x(), p.z()))};
  }
  static Tangents tangents(const Vector3d& p) {
    const double c = std::max(std::hypot(p.x(), p.z()), std::numeric_limits<double>::min());
    return {{p.z(), 0, -p.x()}, {-p.y() * p.x() / c, c, -p.y() * p.z() / c}};
  }
  static bool shows(const Vector3d&) { return true; }
  static bool shows_some(const std::vector<Vector3d>& corners) { return !corners.empty(); }
  static bool may_show(const std::vector<Vector3d>&, const MapWindow&) { return true; }
  static double height(const std::vector<Vector3d>&) { return 1; }
  static std::vector<Vector3d> clipped(const std::vector<Vector3d>& polygon) { return polygon; }
  static Bounds bounds(const Facet& facet);
  static bool direction(const MapPoint& point, Vector3d& p);

  class Rays {
  public:
    Rays(int columns, int rows, const MapWindow& window = {});
    bool at(int row, int column, Vector3d& p) const {
      const auto [sin_v, cos_v] = rows_[static_cast<std::size_t>(row)];
      const auto [sin_u, cos_u] = columns_[static_cast<std::size_t>(column)];
      p = {cos_v * sin_u, sin_v, cos_v * cos_u};
      return true;
    }

  private:
    std::vector<std::array<double, 2>> columns_, rows_; ///< sines and cosines
  };
};

/// The plane itself, for drawing paths: lines are straight, and the clip path selects the visible
/// part.
struct Flat {
  static constexpr double half_width = std::numeric_limits<double>::infinity();
  static constexpr double half_height = half_width;
  static constexpr double period = 0;

  static MapPoint project(const Vector3d& p) { return {p.x(), p.y()}; }
  static bool shows_some(const std::vector<Vector3d>& corners) { return !corners.empty(); }
  static bool may_show(const std::vector<Vector3d>&, const MapWindow&) { return true; }
  static double height(const std::vector<Vector3d>&) { return 1; }
  static std::vector<Vector3d> clipped(const std::vector<Vector3d>& polygon) { return polygon; }
};

/// Calls `act` with the policy of a projection.
template <class Act> auto with_map(Projection projection, Act act) {
  return projection == Projection::globe ? act.template operator()<Orthographic>()
                                         : act.template operator()<PlateCarree>();
}

} // namespace calotte::tools
