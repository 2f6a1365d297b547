// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/along_boundary.h"

#include "domain/near_boundary.h"

#include <algorithm>
#include <cmath>

namespace calotte::domain_detail {
namespace {

/// The unit vector along an edge at a point of it.
template <Space S> Vec3 direction_of(const Arc& edge, const Vec3& at) {
  if constexpr (S::on_sphere)
    return normalised(cross(left_of<S>(edge), at));
  return normalised(edge.to - edge.from);
}

} // namespace

template <Space S> Vec3 left_of(const Arc& edge) {
  if constexpr (S::on_sphere)
    return normalised(cross(edge.from, edge.to));
  const Vec3 way = normalised(edge.to - edge.from);
  return {-way.y, way.x, 0};
}

template <Space S>
Vec3 pushed_inside(const OutlineOf<S>& outline, const Vec3& x, const Vec3& left) {
  constexpr int most_shifts = 8;
  const double roundoff = S::on_sphere ? 0x1p-53 : 0x1p-52 * std::max(std::abs(x.x), std::abs(x.y));
  Vec3 inside = x;
  for (int shift = 1; side_of<S>(&outline, inside) == Side::outside && shift <= most_shifts;
       ++shift) {
    inside = x + (shift * roundoff) * left;
    if constexpr (S::on_sphere)
      inside = normalised(inside);
  }
  return inside;
}

template <Space S> Vec3 along_boundary(const OutlineOf<S>& outline, const Vec3& x, double reach) {
  constexpr double sharp = 0.5; // cosine of 60 degrees
  Vec3 sum{0, 0, 0}, first = sum;
  bool turns = false;
  for_each_edge_near<S>(outline, x, reach, [&](const Arc& edge) {
    const Vec3 apart = nearest_point<S>(edge, x) - x;
    if (!(dot(apart, apart) <= reach * reach))
      return;
    const Vec3 way = direction_of<S>(edge, x);
    turns = turns || (dot(sum, sum) > 0 && dot(first, way) < sharp);
    first = dot(sum, sum) > 0 ? first : way;
    sum = sum + way;
  });
  return turns || !(dot(sum, sum) > 0) ? Vec3{0, 0, 0} : normalised(sum);
}

template <Space S>
Vec3 slid_on_boundary(const OutlineOf<S>& outline, const Vec3& x, const Vec3& way, double reach) {
  const Vec3 to = x + way, along = along_boundary<S>(outline, x, reach);
  Vec3 nearest = x, left{0, 0, 0};
  double least = dot(way, way);
  for_each_edge_near<S>(outline, to, norm(way), [&](const Arc& edge) {
    const Vec3 here = nearest_point<S>(edge, to), apart = here - to;
    if (dot(apart, apart) <= least && dot(direction_of<S>(edge, here), along) > 0) {
      least = dot(apart, apart);
      nearest = here;
      left = left_of<S>(edge);
    }
  });
  return pushed_inside<S>(outline, nearest, left);
}

template Vec3 left_of<Sphere>(const Arc&);
template Vec3 left_of<Plane>(const Arc&);
template Vec3 pushed_inside<Sphere>(const SphericalOutline&, const Vec3&, const Vec3&);
template Vec3 pushed_inside<Plane>(const Outline&, const Vec3&, const Vec3&);
template Vec3 along_boundary<Sphere>(const SphericalOutline&, const Vec3&, double);
template Vec3 along_boundary<Plane>(const Outline&, const Vec3&, double);
template Vec3 slid_on_boundary<Sphere>(const SphericalOutline&, const Vec3&, const Vec3&, double);
template Vec3 slid_on_boundary<Plane>(const Outline&, const Vec3&, const Vec3&, double);

} // namespace calotte::domain_detail
