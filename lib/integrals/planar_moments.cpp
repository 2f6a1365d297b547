// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/planar_moments.h"

#include "integrals/fans.h"

#include <algorithm>
#include <cmath>

namespace calotte::integrals_detail {
namespace {

/// A domain with a boundary, as integrate_within() sees it.
struct BoundedPlane {
  const Outline& outline;
  std::int64_t generators;

  static double reach2(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec2 centre = circumcentre({b.x - a.x, b.y - a.y}, {c.x - a.x, c.y - a.y});
    return dot(centre, centre);
  }

  bool near_boundary(const Vec3& x, double square) const {
    return domain_detail::near_boundary(outline, {x.x, x.y}, std::sqrt(square));
  }

  CellMoments clipped_moments(const Integrand& integrand, const Vec3& x,
                              const std::vector<Vec3>& neighbours) const {
    const Vec2 site{x.x, x.y};
    std::vector<Vec2> beyond;
    for (const Vec3& neighbour : neighbours)
      beyond.push_back({neighbour.x - x.x, neighbour.y - x.y});
    const Box2& box = outline.box();
    const Vec2 margin = box.high - box.low;
    const std::vector<CellSide> sides = clipped_cell(
        outline, site, voronoi_cell({box.low - site - margin, box.high - site + margin}, beyond));
    FanSums sums = sum_fan(integrand, FlatLift(site), sides);
    keep_inside(outline, site, sides, sums);
    return FlatLift::moments(sums);
  }
};

FlatTriangles triangles_in(const PlanarField& field, const Array<Vec3>& x) {
  double largest = std::max(field.plane.period().x, field.plane.period().y);
  for (const Vec3& place : x)
    largest = std::max({largest, std::abs(place.x), std::abs(place.y)});
  return {field.plane, largest};
}

} // namespace

void integrate(const Integrand& integrand, const PlanarField& field, const Patch& patch,
               const Array<Vec3>& x, Array<CellMoments>& moments,
               std::vector<std::int32_t>& suspects) {
  const FlatTriangles plane = triangles_in(field, x);
  if (field.outline == nullptr)
    sum_kites(plane, integrand, patch.corners, x, {moments}, suspects);
  else
    integrate_within(BoundedPlane{*field.outline, field.generators}, plane, integrand, patch, x,
                     moments, suspects);
}

void find_suspects(const PlanarField& field, const Patch& patch, const Array<Vec3>& x,
                   std::vector<std::int32_t>& suspects) {
  find_suspects(triangles_in(field, x), patch.corners, x, suspects);
}

} // namespace calotte::integrals_detail
