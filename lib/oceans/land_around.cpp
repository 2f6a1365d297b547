// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/ocean.h>

#include "base/points.h"
#include "base/require.h"
#include "domain/loops.h"
#include "exact/predicates.h"
#include "oceans/room.h"

#include <cmath>
#include <numbers>

namespace calotte {
namespace {

using namespace oceans_detail;

/// Sines and cosines of azimuths of directions seen from a point, up to a common factor.
class Compass {
public:
  explicit Compass(const Vec3& up) {
    const Vec3 aside = std::abs(up.z) < 0.5 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    east_ = normalised(cross(aside, up));
    north_ = cross(up, east_);
  }
  /// The change of azimuth from one direction to another, from -pi to pi.
  double turn(const Vec3& from, const Vec3& to) const {
    const double x = dot(from, east_), y = dot(from, north_), u = dot(to, east_),
                 v = dot(to, north_);
    return std::atan2(x * v - y * u, x * u + y * v);
  }

private:
  Vec3 east_, north_;
};

/// True if a ring has a point, and not its antipode, to its left: it winds around the line through
/// both, counter-clockwise seen from above the point. It errs by round-off only.
bool is_left_of(const Points3& ring, const Compass& compass) {
  double angle = 0;
  for (Eigen::Index i = 0; i < ring.cols(); ++i)
    angle += compass.turn(column(ring, i), column(ring, i + 1 < ring.cols() ? i + 1 : 0));
  return angle > std::numbers::pi;
}

} // namespace

Surface land_around(const Coast& coast, const Eigen::Vector3d& point) {
  require(point.allFinite() && !point.isZero(0),
          "the place on land is no direction; give three finite numbers that are not all 0");
  const Vec3 here = normalised(Vec3{point.x(), point.y(), point.z()});
  const Compass compass(here);
  Surface smallest;
  double least = 2 * std::numbers::pi; // the left side of a lake's ring is larger
  for (const Points3& ring : coast.rings) {
    if (!is_left_of(ring, compass))
      continue;
    const Surface region = Surface::sphere().within({domain_detail::without_loops(ring)});
    if (region.area() < least && region.contains({here.x, here.y, here.z})) {
      smallest = region;
      least = region.area();
    }
  }
  require(smallest.is_bounded(), "no ring of the coast contains the place; give one on land");
  return smallest;
}

} // namespace calotte
