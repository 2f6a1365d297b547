// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/near_boundary.h"

#include <algorithm>
#include <limits>

namespace calotte::domain_detail {

bool is_near_boundary(const Surface& surface, const Vec3& point, double reach) {
  if (!surface.is_bounded())
    return false;
  bool near = false;
  const auto meets = [&](const Arc&) { near = true; };
  if (surface.is_sphere())
    for_each_edge_near<Sphere>(*outline_of<Sphere>(surface), point, reach, meets);
  else
    for_each_edge_near<Plane>(*outline_of<Plane>(surface), point, reach, meets);
  return near;
}

template <Space S> Vec3 nearest_point(const Arc& edge, const Vec3& x) {
  if constexpr (S::on_sphere) {
    Vec3 nearest = edge.from;
    double least = std::numeric_limits<double>::infinity();
    for_each_part(edge, [&](const Arc& part) {
      const Vec3 here = nearest_on(part, x), apart = here - x;
      if (dot(apart, apart) < least) {
        least = dot(apart, apart);
        nearest = here;
      }
    });
    return nearest;
  } else {
    const Vec3 way = edge.to - edge.from;
    return edge.from + std::clamp(dot(x - edge.from, way) / dot(way, way), 0.0, 1.0) * way;
  }
}

template Vec3 nearest_point<Sphere>(const Arc&, const Vec3&);
template Vec3 nearest_point<Plane>(const Arc&, const Vec3&);

} // namespace calotte::domain_detail
