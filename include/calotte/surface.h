// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/matrices.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

struct Region;
struct PlanarDomain;

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
/// A value that is cheap to copy. Copies share what is prepared for queries; any number of threads
/// may call them.
class Surface {
public:
  /// Closed rings of corners, one a column: 3 rows on the sphere, 2 in the plane.
  using Rings = std::vector<DoubleMatrix>;

  Surface() = default;                 ///< the whole sphere
  Surface(const Region& region);       ///< the part of the sphere; not checked
  Surface(const PlanarDomain& domain); ///< the part of the plane; not checked

  /// The unit sphere.
  static Surface sphere() { return {}; }
  /// The plane without an end.
  static Surface plane();
  /// The plane that repeats in x, in y, or in both.
  /// \param period lengths from 1e-30 to 1e30; 0 in a direction without one; not both 0.
  /// \throws Error bad_option for a length out of range.
  static Surface periodic(const Eigen::Vector2d& period);

  /// The part that rings bound. On the sphere arcs of great circles, shorter than a half circle,
  /// join the corners; the part lies to the left of every ring, seen from outside. In the plane a
  /// point is inside if it lies inside an odd number of rings, of either orientation.
  /// \throws Error bad_option: a plane with a period, or a surface that is bounded already; as
  ///         require_region(); as require_domain().
  Surface within(Rings rings) const;

  bool is_sphere() const { return sphere_; }                   ///< otherwise a plane
  bool is_bounded() const { return bounds_ != nullptr; }       ///< by rings
  bool is_whole_sphere() const { return sphere_ && !bounds_; } ///< without a boundary
  /// True for the doubly periodic box.
  bool is_box() const { return period_.minCoeff() > 0; }
  /// Of the plane in x and y; 0 in a direction without one.
  const Eigen::Vector2d& period() const { return period_; }
  const Rings& rings() const; ///< none if it is not bounded
  /// Steradians, or the square of the plane's unit; infinite for a plane that has no end.
  double area() const;
  /// True if a point lies inside or on the boundary; in a periodic direction, if it lies in the
  /// half-open period. Exact. False for points that are not finite, and for the vector 0 on the
  /// sphere.
  bool contains(const Eigen::Vector3d& point) const;

  /// True for the same kind, period and rings.
  friend bool operator==(const Surface& a, const Surface& b) { return a.equals(b); }

private:
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

} // namespace calotte
CALOTTE_API_END
