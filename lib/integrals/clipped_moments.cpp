// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/clipped_moments.h"

#include "domain/clipped_cell.h"
#include "domain/tangent_outline.h"
#include "integrals/fans.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace calotte::integrals_detail {
namespace {

/// The Voronoi cell of the site 0, cut to a box. \param beyond its neighbours.
std::vector<CellCorner> voronoi_cell(const Box2& box, const std::vector<Vec2>& beyond) {
  std::vector<CellCorner> cell{
      {box.low, {}}, {{box.high.x, box.low.y}, {}}, {box.high, {}}, {{box.low.x, box.high.y}, {}}};
  for (const Vec2& neighbour : beyond)
    cell = cut_by_bisector(cell, neighbour);
  return cell;
}

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

/// Moves the centroid of a cell that lies outside to the nearest point of the boundary within the
/// cell.
template <class AnyOutline>
void keep_inside(const AnyOutline& outline, const Vec2& site, const std::vector<CellSide>& sides,
                 FanSums& sums) {
  const Vec2 centroid = (1 / sums.height) * sums.along;
  if (!(sums.height > 0) || outline.side(site + centroid) == Side::inside)
    return;
  sums.along = sums.height * nearest_inside(outline, site, sides, centroid).value_or(Vec2{0, 0});
}

} // namespace

double circumradius2(const Sphere&, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(b - a, c - a), apart = (1 / norm(normal)) * normal - a;
  return dot(apart, apart);
}

double circumradius2(const Plane&, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec2 centre = circumcentre({b.x - a.x, b.y - a.y}, {c.x - a.x, c.y - a.y});
  return dot(centre, centre);
}

bool near_boundary(const SphericalOutline& outline, const Vec3& x, double square) {
  const double reach = 2 * std::asin(std::min(std::sqrt(square) / 2, 1.0));
  bool near = false;
  outline.for_each_edge_near(x, 1.000001 * reach,
                             [&](const SphericalOutline::Edge&) { near = true; });
  return near;
}

bool near_boundary(const Outline& outline, const Vec3& x, double square) {
  return domain_detail::near_boundary(outline, {x.x, x.y}, std::sqrt(square));
}

CellMoments clipped_moments(const Integrand& integrand, const SphericalOutline& outline,
                            const Vec3& site, const std::vector<Vec3>& neighbours) {
  const TangentPlane plane(site);
  const TangentOutline boundary(outline, plane);
  const TangentLift lift(plane);
  const std::vector<CellSide> sides =
      clipped_cell(boundary, Vec2{0, 0}, tangent_cell(plane, neighbours));
  FanSums sums = sum_fan(integrand, lift, sides);
  keep_inside(boundary, Vec2{0, 0}, sides, sums);
  return lift.moments(sums);
}

CellMoments clipped_moments(const Integrand& integrand, const Outline& outline, const Vec3& x,
                            const std::vector<Vec3>& neighbours) {
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
