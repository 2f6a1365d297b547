// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/plane_chart.h"

#include <algorithm>

namespace calotte::delaunay_detail {
namespace {

/// An upper bound of the scaled coordinates.
double largest(const Frame& frame) {
  return std::max(std::abs(frame.centre.x), std::abs(frame.centre.y)) + frame.half;
}

} // namespace

/// Static bounds, for points at most D = twice the reach apart. Let u be the roundoff; a difference
/// of stored coordinates is within u of the true one, relative.
///
/// Orientation: two products of differences, each within 3u, and their difference: 4u times the sum
/// of the products' sizes, which is at most D^2.
///
/// In-circle: |p|^2 is within 5u; a product of three differences within 7u; so a coordinate of the
/// normal's horizontal part, at most 2 D^3, is within 16u D^3, and the vertical one, at most D^2,
/// within 4u D^2. Times the offset and its square, and summed up, that is below 80u D^4, or by the
/// triangle's size L and the offset's size s, 80u L^2 s (L + s).
///
/// An image's coordinate errs by e = u times the largest, a difference by 2e: the orientation by
/// another 8e D, the in-circle determinant, whose derivative with respect to a coordinate of one of
/// the four points is below 6 D^3, by 48e D^3.
void PlaneChart::widen(double reach) {
  reach_ = reach;
  // Frame coordinates err by 3 roundoffs: points may be that much further apart than they say.
  const double d = 2.01 * (reach + 64 * roundoff) * sites_->frame->half;
  image_error_ = periodic() ? roundoff * largest(*sites_->frame) : 0;
  orientation_error_ = (8 * roundoff * d + 8 * image_error_) * d + least_error;
  in_circle_error_ = (80 * roundoff * d + 50 * image_error_) * d * d * d + least_error;
}

PlaneChart::Point PlaneChart::point(std::int64_t rank) {
  const Vec3& unit = sites_->unit[rank];
  const std::int32_t site = sites_->id[rank];
  const Vec3& given = sites_->given(site);
  const double scale = sites_->frame->scale;
  if (const Vec3 offset = unit - centre_; dot(offset, offset) > reach_ * reach_)
    widen(1.01 * norm(offset));
  return {unit, scale * given.x, scale * given.y, site};
}

int PlaneChart::orientation_beyond_static(const Point& a, const Point& b, const Point& c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
  const double extent =
      std::abs(b.x - a.x) + std::abs(b.y - a.y) + std::abs(c.x - a.x) + std::abs(c.y - a.y);
  const double error = 5 * roundoff * (std::abs(left) + std::abs(right)) +
                       4 * image_error_ * (extent + image_error_) + least_error;
  if (left - right > error)
    return 1;
  if (left - right < -error)
    return -1;
  return exact_detail::orientation(sites_->frame->period, image(a), image(b), image(c));
}

int PlaneChart::in_circle_beyond_local(const Point& a, const Point& b, const Point& c,
                                       const Point& d) {
  ++counts_.filtered;
  const Vec2& period = sites_->frame->period;
  const Image p = image(a), q = image(b), r = image(c), s = image(d);
  if (const int sign = exact_detail::in_circle(period, p, q, r, s))
    return sign;
  ++counts_.exact;
  return in_circle_tie(period, p, q, r, s);
}

} // namespace calotte::delaunay_detail
