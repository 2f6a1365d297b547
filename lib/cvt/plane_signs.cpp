// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"
#include "base/triangle.h"
#include "cvt/signs.h"
#include "delaunay/delaunay.h"
#include "exact/predicates.h"
#include "mesh/planar_mesh.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte::cvt_detail {
namespace {

double size_of(const Vec2& v) { return std::max(std::abs(v.x), std::abs(v.y)); }

} // namespace

/// The copy of a site that is nearest to an image.
Image PlaneSigns::next_to(const Image& image, std::int32_t site) const {
  const Vec2 place = given(site);
  return {place, image.i + static_cast<int>(periods_between(image.site.x, place.x, period_.x)),
          image.j + static_cast<int>(periods_between(image.site.y, place.y, period_.y))};
}

Vec2 PlaneSigns::offset(const Image& from, const Image& to) const {
  return {to.site.x - from.site.x + (to.i - from.i) * period_.x,
          to.site.y - from.site.y + (to.j - from.j) * period_.y};
}

/// In a box the offsets from a corner err by up to e = 2u L each, u the roundoff and L the longer
/// period: a difference of places in the box and the sum of that and a period are rounded, each to
/// u L at most, as is a product with -1, 0 or 1 times the period not at all. With offsets up to D,
/// the products' and their difference's rounding adds 4u D^2: in all below 4 D e + 2 e^2 + 4u D^2.
bool PlaneSigns::is_counter_clockwise(const Corners& triangle) const {
  const Image a{given(triangle[0]), 0, 0}, b = next_to(a, triangle[1]), c = next_to(a, triangle[2]);
  if (!periodic())
    return orientation(period_, a, b, c) > 0;
  const Vec2 p = offset(a, b), q = offset(a, c);
  // The nearest copies for the way from b to c may differ from those seen from a.
  if (!within_half({1.000001 * (q.x - p.x), 1.000001 * (q.y - p.y)}, period_))
    return false;
  const double value = p.x * q.y - p.y * q.x, e = 2 * roundoff * size_of(period_),
               d = std::max(size_of(p), size_of(q)), error = 8 * d * e + 8 * roundoff * d * d;
  if (std::abs(value) > error)
    return value > 0;
  return orientation(period_, a, b, c) > 0;
}

/// The offsets p and q err by up to e = 4u M each, M the largest coordinate: their scalar product
/// by less than 2 (|p| + |q|) e.
bool PlaneSigns::is_clearly_acute(const Corners& triangle, int v) const {
  const auto at = [&](int i) { return triangle[static_cast<std::size_t>(i)]; };
  const Image here{given(at(v)), 0, 0};
  const Vec2 p = offset(here, next_to(here, at(next_vertex(v)))),
             q = offset(here, next_to(here, at(previous_vertex(v))));
  const double largest = size_of(here.site) + size_of(p) + size_of(q) + size_of(period_);
  return p.x * q.x + p.y * q.y > 16 * roundoff * largest * (size_of(p) + size_of(q));
}

/// With offsets from a as above, the determinant is a sum of 12 products of four of them: it errs
/// by up to 48 D^3 e, and by 12 * 10u D^4 of its own rounding.
bool PlaneSigns::circle_holds(const Corners& triangle, int v, std::int32_t d) const {
  std::array<Image, 3> corner{};
  corner[0] = {given(triangle[0]), 0, 0};
  corner[1] = next_to(corner[0], triangle[1]);
  corner[2] = next_to(corner[0], triangle[2]);
  const Image far = next_to(corner[static_cast<std::size_t>(next_vertex(v))], d);
  const auto filter = [&] {
    const Vec2 p = offset(far, corner[0]), q = offset(far, corner[1]), r = offset(far, corner[2]);
    const auto square = [](const Vec2& x) { return x.x * x.x + x.y * x.y; };
    const double value = square(p) * (q.x * r.y - q.y * r.x) - square(q) * (p.x * r.y - p.y * r.x) +
                         square(r) * (p.x * q.y - p.y * q.x);
    const double e = 4 * roundoff * size_of(period_),
                 most = std::max({size_of(p), size_of(q), size_of(r)});
    const double error = (64 * e + 160 * roundoff * most) * most * most * most;
    return value > error ? 1 : value < -error ? -1 : 0;
  };
  int sign = periodic() ? filter() : 0;
  if (sign == 0)
    sign = in_circle(period_, corner[0], corner[1], corner[2], far);
  return (sign != 0 ? sign : in_circle_tie(period_, corner[0], corner[1], corner[2], far)) > 0;
}

Connectivity PlaneSigns::triangulate() const {
  Points2 points(2, sites());
  for_each_block(sites(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      points.col(i) << (*places_)[i].x, (*places_)[i].y;
  });
  PlanarMesh mesh = periodic() ? periodic_delaunay(points, Eigen::Vector2d(period_.x, period_.y))
                               : planar_delaunay(points);
  if (mesh.points.cols() != points.cols())
    throw Error(ErrorCode::too_few_sites, "two generators have met: spread the start over the "
                                          "domain, or take a smoother density");
  return {std::move(mesh.triangles), std::move(mesh.neighbours)};
}

} // namespace calotte::cvt_detail
