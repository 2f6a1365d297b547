// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/matrices.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

namespace domain_detail {
struct UncheckedSurface;
}

/// Where points live: the unit sphere, the plane, or a plane that is periodic in one direction or
/// in both; whole, or the part that rings bound. Points are 3 x n: directions on the sphere; x, y
/// and 0 in the plane, in any unit of length.
///
///     Surface::sphere()                          // also the default
///     Surface::sphere().within({ring})           // a region, to the left of its rings
///     Surface::plane().within({outer, island})   // a domain
///     Surface::periodic({lx, ly})                // the box [0, lx) x [0, ly)
///     Surface::periodic({lx, 0})                 // a channel along x
///
/// A value that is cheap to copy. Copies share the data that are prepared for queries. Any number
/// of threads may call const functions.
class Surface {
public:
  /// Closed rings of corners, one a column: 3 rows on the sphere, 2 in the plane.
  using Rings = std::vector<DoubleMatrix>;

  Surface() = default; ///< the whole sphere

  /// The unit sphere.
  static Surface sphere() { return {}; }
  /// The whole plane.
  static Surface plane();
  /// The plane that repeats in x, in y, or in both.
  /// \param period lengths from 1e-30 to 1e30; 0 in a direction without one; not both 0.
  /// \throws Error invalid_argument for a length out of range.
  static Surface periodic(const Eigen::Vector2d& period);

  /// The part that rings bound. On the sphere arcs of great circles, shorter than a half circle,
  /// join the corners; the part lies to the left of every ring, seen from outside. In the plane a
  /// point is inside if it lies inside an odd number of rings, of either orientation. The corners
  /// are finite, in the plane at most 1e30.
  /// \throws Error invalid_argument: a plane with a period, or a surface that is bounded already;
  ///         naming ring and corner, with the ring as index(): another number of rows; fewer than
  ///         three corners; a corner that is no direction, or not finite; neighbours that are
  ///         equal, or opposite on the sphere; edges that meet elsewhere than in the corner that
  ///         joins them; on the sphere, rings of which one does not have the part to its left.
  Surface within(Rings rings) const;

  bool is_sphere() const { return sphere_; }                   ///< otherwise a plane
  bool is_bounded() const { return bounds_ != nullptr; }       ///< by rings
  bool is_whole_sphere() const { return sphere_ && !bounds_; } ///< without a boundary
  /// True for the doubly periodic box.
  bool is_box() const { return period_.minCoeff() > 0; }
  /// The periods of the plane in x and y; 0 in a direction without a period.
  const Eigen::Vector2d& period() const { return period_; }
  const Rings& rings() const; ///< none if it is not bounded
  /// The area: steradians, or the square of the plane's unit; infinite for a plane
  /// without an end.
  double area() const;
  /// True if a point lies inside or on the boundary; in a periodic direction, if it lies in the
  /// half-open period. Exact. False for points that are not finite, and for the vector 0 on the
  /// sphere.
  bool contains(const Eigen::Vector3d& point) const;

  /// True if both have the same kind, period and rings.
  friend bool operator==(const Surface& a, const Surface& b) { return a.equals(b); }

private:
  friend struct domain_detail::UncheckedSurface;
  struct Bounds;
  bool equals(const Surface& other) const;

  bool sphere_ = true;
  Eigen::Vector2d period_{0, 0};
  std::shared_ptr<const Bounds> bounds_;
};

/// The directions in which a plane ends at walls instead of being periodic.
struct Walls {
  bool x = false; ///< walls at the ends of x
  bool y = false; ///< walls at the ends of y
};

/// The rectangle [lower.x, upper.x] x [lower.y, upper.y], in any unit of length.
/// \param lower, upper opposite corners; finite.
/// \throws Error invalid_argument unless lower < upper in both coordinates.
Surface rectangle(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper);

/// A circle around a centre, as a regular polygon with corners on the circle.
/// \param centre direction of any norm.
/// \param radius angle in radians, from 1e-6 to pi - 1e-6.
/// \param corners 8 to 2^24; the first is north of the centre. Default 360.
/// \throws Error invalid_argument for a value out of range.
Surface circle(const Eigen::Vector3d& centre, double radius, int corners = 360);

/// An ellipse, as a polygon with corners on it: the points whose distances from two foci have a sum
/// of twice the semi-major axis.
/// \param semi_major, semi_minor angles in radians; 1e-6 <= semi_minor <= semi_major <= pi/2 -
///        1e-6.
/// \param bearing of the major axis at the centre, radians clockwise from north; at a pole, north
///        is that of longitude 0.
/// \param corners as for a circle; the first is at an end of the major axis.
/// \throws Error invalid_argument for a value out of range.
Surface ellipse(const Eigen::Vector3d& centre, double semi_major, double semi_minor, double bearing,
                int corners = 360);

/// The band between two latitudes, as polygons with corners on the parallels at equal longitudes.
/// Each arc between corners is poleward of its parallel, by 122 m on the Earth at most for 360
/// corners.
/// \param lower, upper radians, -pi/2 to pi/2; 1e-6 or more from each other and from a pole that is
///        not one of them. A band up to a pole contains it.
/// \param corners as for a circle, of each parallel; the first is at longitude 0.
/// \throws Error invalid_argument for a value out of range, and for the whole sphere.
Surface channel(double lower, double upper, int corners = 360);

/// The part of the sphere between two meridians and two parallels. Its sides on meridians are arcs
/// of great circles. Those on parallels have corners at equal longitudes, so many that no arc is
/// farther from its parallel than 1/60 000 000 of the side: a thousandth of a cell where 60 000
/// cells lie along it, and at most 70 cm on the Earth.
/// \param west, east longitudes, radians, finite; the box runs eastward from west to east, over the
///        date line if east < west. 2 pi apart they give the band between the parallels.
/// \param south, north latitudes, radians, as for a channel(). Up to a pole the box is a sector
///        of its cap.
/// \returns the box; the corners of its rings are unit columns, counter-clockwise around it.
/// \throws Error invalid_argument for a value out of range, a box without width, one wider than
///         2 pi, and for the whole sphere.
Surface box(double west, double south, double east, double north);

/// The region that rings enclose. One rule applies to all rings of users and files, in either
/// direction: they enclose the side without poles, as on a map of longitudes and latitudes; if both
/// sides have a pole, or the rings pass through one, they enclose the smaller side, and of two
/// equal ones that to the left of the first ring. So a ring of one continent or ocean encloses it,
/// and a ring around a pole its polar cap.
///
/// Corners that repeat the one before are ignored, and a ring may repeat its first corner at its
/// end. Arcs that occur in both directions are no boundary: areas that are cut at a meridian are
/// joined, and a ring may reach a pole along a meridian and return along it. Where rings would
/// meet, both sides of such a cut may differ by 1e-9 radians (6 mm on the Earth), and in their
/// corners.
/// \param rings as for Surface::within(); at least one. Several enclose one of the two parts into
///        which they cut the sphere, such that every arc is between both.
/// \throws Error as Surface::within(), orientation aside.
Surface enclosed_region(const std::vector<Points3>& rings);

/// The same for the side of the rings that contains a point.
/// \param point direction of any norm, not on a ring.
/// \throws Error as above; invalid_argument for a point on the boundary.
Surface region_around(const std::vector<Points3>& rings, const Eigen::Vector3d& point);

/// A region that contains all points within a distance of another region, and few more: the
/// boundary moves outwards in a stereographic projection about the middle of the region. The whole
/// sphere if the result would reach farther than 2 radians from there.
/// \param region the sphere or a part of it.
/// \param distance angle in radians, > 0 and finite.
/// \throws Error invalid_argument for a plane, and for a distance out of range.
Surface widened(const Surface& region, double distance);

} // namespace calotte
CALOTTE_API_END
