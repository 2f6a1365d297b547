// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/plane_predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>

namespace calotte::exact_detail {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_2 point(const Vec2& a) { return {a.x, a.y}; }

using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;

Exact::Point_2 exact_point(const Vec2& period, const Image& a) {
  const CGAL::Exact_rational x(a.site.x), y(a.site.y), width(period.x), height(period.y);
  return {x + a.i * width, y + a.j * height};
}

/// Signs are invariant under a common shift by whole periods.
bool in_one_box(const Image& a, const Image& b) { return a.i == b.i && a.j == b.j; }

/// With lifts l and vectors from d, the determinant is l_a b x c - l_b a x c + l_c a x b, and that
/// of l_d makes the sum of the coefficients 0. \param order by which the sites' eps fall. \param
/// turn orientation of three of them.
template <class Site, class Order, class Turn>
int tie(const Site& a, const Site& b, const Site& c, const Site& d, const Order& order,
        const Turn& turn) {
  const std::array<const Site*, 4> sites{&a, &b, &c, &d};
  const auto first = std::min_element(
      sites.begin(), sites.end(), [&](const Site* p, const Site* q) { return order(*p, *q) < 0; });
  switch (first - sites.begin()) {
  case 0:
    return turn(d, b, c);
  case 1:
    return -turn(d, a, c);
  case 2:
    return turn(d, a, b);
  default:
    return -turn(a, b, c);
  }
}

} // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  return CGAL::orientation(point(a), point(b), point(c));
}

int in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return CGAL::side_of_oriented_circle(point(a), point(b), point(c), point(d));
}

int compare_distances(const Vec2& p, const Vec2& a, const Vec2& b) {
  return CGAL::compare_distance_to_point(point(p), point(a), point(b));
}

int in_circle_tie(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return tie(a, b, c, d, compare,
             [](const Vec2& p, const Vec2& q, const Vec2& r) { return orientation(p, q, r); });
}

int orientation(const Vec2& period, const Image& a, const Image& b, const Image& c) {
  if (in_one_box(a, b) && in_one_box(a, c))
    return orientation(a.site, b.site, c.site);
  return CGAL::orientation(exact_point(period, a), exact_point(period, b), exact_point(period, c));
}

int compare_distances(const Vec2& period, const Image& p, const Image& a, const Image& b) {
  if (in_one_box(p, a) && in_one_box(p, b))
    return compare_distances(p.site, a.site, b.site);
  return CGAL::compare_distance_to_point(exact_point(period, p), exact_point(period, a),
                                         exact_point(period, b));
}

bool between(const Vec2& period, const Image& a, const Image& p, const Image& b) {
  if (in_one_box(a, p) && in_one_box(a, b))
    return between(a.site, p.site, b.site);
  return CGAL::collinear_are_strictly_ordered_along_line(
      exact_point(period, a), exact_point(period, p), exact_point(period, b));
}

int in_circle(const Vec2& period, const Image& a, const Image& b, const Image& c, const Image& d) {
  if (in_one_box(a, b) && in_one_box(a, c) && in_one_box(a, d))
    return in_circle(a.site, b.site, c.site, d.site);
  return CGAL::side_of_oriented_circle(exact_point(period, a), exact_point(period, b),
                                       exact_point(period, c), exact_point(period, d));
}

int in_circle_tie(const Vec2& period, const Image& a, const Image& b, const Image& c,
                  const Image& d) {
  const auto order = [](const Image& p, const Image& q) {
    const int by_site = compare(p.site, q.site);
    return by_site != 0 ? by_site : compare({double(p.i), double(p.j)}, {double(q.i), double(q.j)});
  };
  return tie(a, b, c, d, order, [&](const Image& p, const Image& q, const Image& r) {
    return orientation(period, p, q, r);
  });
}

} // namespace calotte::exact_detail
