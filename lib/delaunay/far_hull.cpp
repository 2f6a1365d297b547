// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/far_hull.h"

#include "base/points.h"
#include "base/vec3.h"

#include <calotte/generators.h>

#include <vector>

namespace calotte::delaunay_detail {

Points3 far_hull(const Outline& outline) {
  const Box2& box = outline.box();
  const Vec2 extent{box.high.x - box.low.x, box.high.y - box.low.y};
  const double x = box.low.x + extent.x / 2, y = box.low.y + extent.y / 2,
               far = 8 * (extent.x + extent.y);
  Points3 hull(3, 3);
  set_column(hull, 0, {x, y + far, 0});
  set_column(hull, 1, {x - 0.75 * far, y - far / 2, 0});
  set_column(hull, 2, {x + 0.75 * far, y - far / 2, 0});
  return hull;
}

Points3 far_hull(const SphericalOutline& outline) {
  constexpr int level = 1; // 42 directions
  constexpr double distance = 0.5;
  const Points3 directions = bisected_icosahedron(level);
  std::vector<Eigen::Index> far;
  for (Eigen::Index i = 0; i < directions.cols(); ++i) {
    bool near = outline.side(column(directions, i)) != Side::outside;
    outline.for_each_edge_near(column(directions, i), distance,
                               [&](const SphericalOutline::Edge&) { near = true; });
    if (!near)
      far.push_back(i);
  }
  return directions(Eigen::all, far);
}

Surface unbounded(const Surface& surface) {
  if (!surface.is_bounded())
    return surface;
  return surface.is_sphere() ? Surface::sphere() : Surface::plane();
}

} // namespace calotte::delaunay_detail
