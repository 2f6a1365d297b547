// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/region_moments.h"

#include "domain/tangent_outline.h"
#include "integrals/fans.h"

#include <algorithm>
#include <cmath>

namespace calotte::integrals_detail {
namespace {

/// The Voronoi cell in the plane that touches the sphere at its site, cut to a square.
std::vector<CellCorner> tangent_cell(const TangentPlane& plane,
                                     const std::vector<Vec3>& neighbours) {
  std::vector<Vec2> beyond;
  for (const Vec3& neighbour : neighbours) {
    const Vec2 along = plane.along(neighbour);
    if (dot(along, along) > 1e-20) // the bisector with an opposite site is farther than the square
      beyond.push_back(plane.mirrored(neighbour));
  }
  return voronoi_cell(TangentOutline::box(), beyond);
}

/// A region, as integrate_within() sees it.
struct BoundedSphere {
  const SphericalOutline& outline;
  std::int64_t generators;

  static double reach2(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = cross(b - a, c - a), apart = (1 / norm(normal)) * normal - a;
    return dot(apart, apart);
  }

  bool near_boundary(const Vec3& x, double square) const {
    const double reach = 2 * std::asin(std::min(std::sqrt(square) / 2, 1.0));
    bool near = false;
    outline.for_each_edge_near(x, 1.000001 * reach,
                               [&](const SphericalOutline::Edge&) { near = true; });
    return near;
  }

  CellMoments clipped_moments(const Integrand& integrand, const Vec3& x,
                              const std::vector<Vec3>& neighbours) const {
    const TangentPlane plane(x);
    const TangentOutline boundary(outline, plane);
    const TangentLift lift(plane);
    const std::vector<CellSide> sides =
        clipped_cell(boundary, Vec2{0, 0}, tangent_cell(plane, neighbours));
    FanSums sums = sum_fan(integrand, lift, sides);
    keep_inside(boundary, Vec2{0, 0}, sides, sums);
    return lift.moments(sums);
  }
};

} // namespace

void integrate(const Integrand& integrand, const RegionField& field, const Patch& patch,
               const Array<Vec3>& x, Array<CellMoments>& moments,
               std::vector<std::int32_t>& suspects) {
  integrate_within(BoundedSphere{*field.outline, field.generators}, SphericalTriangles{}, integrand,
                   patch, x, moments, suspects);
}

double clipped_area(const SphericalOutline& outline, const Vec3& site,
                    const std::vector<Vec3>& neighbours) {
  const TangentPlane plane(site);
  double area = 0;
  for (const CellSide& side :
       clipped_cell(TangentOutline(outline, plane), Vec2{0, 0}, tangent_cell(plane, neighbours)))
    area += TangentLift::area(side);
  return area;
}

} // namespace calotte::integrals_detail
