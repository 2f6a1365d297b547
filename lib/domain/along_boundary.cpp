// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/along_boundary.h"

#include "domain/outline.h"
#include "domain/spherical_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace calotte::domain_detail {
namespace {

/// Calls body(edge) for the edges of a boundary that may come within a distance of a point.
template <Space S, class Body>
void for_each_edge_near(const OutlineOf<S>& outline, const Vec3& x, double reach,
                        const Body& body) {
  if constexpr (S::on_sphere) {
    outline.for_each_edge_near(x, reach, body);
  } else {
    outline.for_each_edge_near(
        {{x.x - reach, x.y - reach}, {x.x + reach, x.y + reach}}, [&](const Outline::Edge& edge) {
          body(Arc{{edge.from.x, edge.from.y, 0}, {edge.to.x, edge.to.y, 0}});
        });
  }
}

/// The point of an edge nearest to x.
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
