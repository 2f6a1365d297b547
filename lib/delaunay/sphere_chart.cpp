// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/sphere_chart.h"

namespace calotte::delaunay_detail {
namespace {

/// The projection is not used beyond this chord from the centre (120 degrees), because its error
/// grows without bound.
constexpr double farthest_projected = 1.7320508;

} // namespace

SphereChart::SphereChart(const Sites& sites, const Vec3& centre, double reach)
    : sites_(&sites), view_{false, -centre}, centre_(centre), projected_(true) {
  const Vec3 axis = std::abs(centre.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  east_ = normalised(cross(axis, centre));
  north_ = cross(centre, east_);
  widen(reach);
}

/// Static bounds for sites within that chord of the centre.
///
/// In-circle: any two of them are at most D = twice the reach apart, so that the normal n is at
/// most D^2 long. Let u be the roundoff. The products n.d and n.a are rounded by 3u |n||d| each and
/// their difference by u times itself, at most 2u D^2, instead of the product of n with d - a: 8u
/// D^2 more than in_circle_error() allows for.
///
/// Orientation: the axes are within 16u of an orthonormal frame around the exact focus, the site
/// within 5u, a 3-term sum rounds by 5u: a numerator errs by 26u, a denominator 1 + c.x >= 1/2 by
/// 18u, so that a coordinate, at most sqrt(3), errs by 52u + 63u + 4u = 119u =: e. A difference, at
/// most D = 2 P long, P the largest projected norm, then errs by f = 2e + uD in each coordinate,
/// and the determinant by 2 sqrt(2) D f + 2 f^2 + 3u D^2 for its evaluation. Nothing is decided
/// unless D > 1000u, where that is below 800 u D.
void SphereChart::widen(double reach) {
  reach_ = reach;
  const double apart = std::min(2 * reach, 2.0);
  in_circle_error_ = in_circle_error(apart) + 8 * roundoff * apart * apart;
  if (reach > farthest_projected)
    projected_ = false;
  if (!projected_)
    return;
  const double half = std::min(reach / 2, 0.87); // sine of half the angle; P is its tangent
  const double span = 2 * half / std::sqrt(1 - half * half);
  orientation_error_ = 1000 * roundoff * span;
}

bool SphereChart::has_point(std::int64_t rank) const {
  if (view_.from_centre || dot(sites_->unit[rank], view_.focus) < 0.5)
    return true;
  return !same_direction(sites_->given(sites_->id[rank]), view_.focus);
}

SphereChart::Point SphereChart::point(std::int64_t rank) {
  const Vec3& unit = sites_->unit[rank];
  Point p{unit, 0, 0, sites_->id[rank]};
  if (view_.from_centre)
    return p;
  const Vec3 offset = unit - centre_;
  if (dot(offset, offset) > reach_ * reach_)
    widen(std::min(1.01 * norm(offset), 2.0));
  if (projected_) {
    const double scale = 1 / (1 + dot(unit, centre_));
    p.x = dot(unit, east_) * scale;
    p.y = dot(unit, north_) * scale;
  }
  return p;
}

int SphereChart::orientation_beyond_filter(const Point& a, const Point& b, const Point& c) {
  const int sign = view_.from_centre ? orientation_filter(a.unit, b.unit, c.unit)
                                     : -in_circle_filter(a.unit, b.unit, c.unit, view_.focus);
  if (sign != 0)
    return sign;
  return exact_detail::orientation(view_, given(a), given(b), given(c));
}

int SphereChart::in_circle_beyond_static(const Point& a, const Point& b, const Point& c,
                                         const Point& d) {
  if (const int sign = in_circle_filter(a.unit, b.unit, c.unit, d.unit))
    return sign;
  const int sign = in_circle_beyond_filter(given(a), given(b), given(c), given(d), counts_);
  return sign != 0 ? sign : in_circle_tie(view_, given(a), given(b), given(c), given(d));
}

} // namespace calotte::delaunay_detail
