// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/near_boundary.h"

#include "domain/outline.h"
#include "domain/spherical_outline.h"
#include "domain/surface.h"

namespace calotte::domain_detail {

bool is_near_boundary(const Surface& surface, const Vec3& point, double reach) {
  if (!surface.is_bounded())
    return false;
  bool near = false;
  const auto meets = [&](const auto&) { near = true; };
  if (surface.is_sphere())
    outline_of<Sphere>(surface)->for_each_edge_near(point, reach, meets);
  else
    outline_of<Plane>(surface)->for_each_edge_near(
        {{point.x - reach, point.y - reach}, {point.x + reach, point.y + reach}}, meets);
  return near;
}

} // namespace calotte::domain_detail
