// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/room.h"
#include "domain/arc_tree.h"
#include "domain/arcs.h"

#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <limits>
#include <span>
#include <vector>

namespace calotte::density_detail {

/// Distances from the nearest of many segments and points: arcs of the unit sphere, or straight
/// lines of a plane.
class LineDistance {
public:
  /// \param lines see Widths::by_distance(). \throws Error as there.
  LineDistance(const std::vector<Points3>& lines, const Surface& surface);

  bool on_sphere() const { return sphere_; }

  /// The distances at unit vectors, in radians; in a plane at x y 0, in its unit. Faster if
  /// consecutive points are near each other.
  /// \param farthest distances beyond it may come out larger than they are.
  void operator()(std::span<const Vec3> points, std::span<double> distances,
                  double farthest = std::numeric_limits<double>::infinity()) const;

  double operator()(const Vec3& point) const {
    double distance = 0;
    (*this)({&point, 1}, {&distance, 1});
    return distance;
  }

  /// The nearest point of the lines to a unit vector, on the sphere.
  Vec3 nearest(const Vec3& point) const;

private:
  bool sphere_;
  std::vector<Arc> arcs_; ///< or straight lines; of a point both ends are the same
  BoxTree tree_;
};

} // namespace calotte::density_detail
