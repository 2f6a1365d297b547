// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/room.h"
#include "delaunay/sites.h"
#include "exact/predicates.h"

#include <algorithm>
#include <cmath>

namespace calotte::delaunay_detail {

/// The sphere as seen from one region, the first model of a Chart.
///
/// A Chart views its domain from one region. It provides `Point`, the coordinates that the
/// triangulation stores in a vertex; `point`, which makes one from a site that `has_point`;
/// `expect`, which prefetches the data that `point` reads; `circle`, the values that the in-circle
/// tests of a triangle share; and the signs `orientation`, `between` and `in_circle` of three or
/// four points, with ties resolved. `in_circle` is not 0 for a triangle of the triangulation and
/// another site.
///
/// On the sphere the view is stereographic from the focus opposite to a cap's centre (Jacobsen et
/// al., 2013, Eq. 5), or central for a whole set. The projected doubles of a point filter
/// orientations only; the unit vector filters in-circle signs. The exact predicates on the given
/// directions decide the rest.
class SphereChart {
public:
  struct Point {
    Vec3 unit;
    double x, y; ///< stereographic, from the focus
    std::int32_t site;
  };

  /// The values that all in-circle tests of one triangle share: the normal n = (b - a) x (c - a) of
  /// the flat triangle, and n.a; the determinant is n.d - n.a.
  struct Circle {
    Vec3 normal;
    double offset = 0;
  };

  /// The greatest chord.
  static constexpr double diameter = 2;

  static Surface surface() { return Surface::sphere(); } ///< of the mesh

  /// The whole sphere from its centre.
  explicit SphereChart(const Sites& sites) : sites_(&sites) { widen(2); }

  /// A cap from the focus -centre; `reach` bounds the chord from the centre (a unit vector) to its
  /// sites.
  SphereChart(const Sites& sites, const Vec3& centre, double reach);

  /// True if a site has a point in the chart. All sites have one, except a site at the focus
  /// itself.
  bool has_point(std::int64_t rank) const;

  /// Announces the use of a point. No prefetch is needed, because ranks are consecutive in memory.
  static void expect(std::int64_t) {}

  /// True if all sites within that chord of the centre have points.
  static constexpr bool has_all_points(double reach) { return reach < 1.9; }

  /// The chart's point of a site; widens the error bounds if the site exceeds them.
  Point point(std::int64_t rank);

  const View& view() const { return view_; }
  const PredicateCounts& counts() const { return counts_; }

  int orientation(const Point& a, const Point& b, const Point& c) {
    if (projected_) {
      const double value = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      if (value > orientation_error_)
        return 1;
      if (value < -orientation_error_)
        return -1;
    }
    return orientation_beyond_filter(a, b, c);
  }

  bool between(const Point& a, const Point& p, const Point& b) const {
    return exact_detail::between(view_, given(a), given(p), given(b));
  }

  static Circle circle(const Point& a, const Point& b, const Point& c) {
    const Vec3 normal = cross(b.unit - a.unit, c.unit - a.unit);
    return {normal, dot(normal, a.unit)};
  }

  /// \param circle that of a, b, c.
  int in_circle(const Circle& circle, const Point& a, const Point& b, const Point& c,
                const Point& d) {
    const double value = dot(circle.normal, d.unit) - circle.offset;
    if (value > in_circle_error_)
      return 1;
    if (value < -in_circle_error_) [[likely]]
      return -1;
    return in_circle_beyond_static(a, b, c, d);
  }

private:
  const Vec3& given(const Point& a) const { return sites_->given(a.site); }
  void widen(double reach);
  int orientation_beyond_filter(const Point& a, const Point& b, const Point& c);
  int in_circle_beyond_static(const Point& a, const Point& b, const Point& c, const Point& d);

  const Sites* sites_;
  View view_;
  Vec3 centre_{0, 0, 0}, east_{0, 0, 0}, north_{0, 0, 0};
  double reach_ = 0;
  bool projected_ = false; ///< all points so far have projections within the error bound
  double in_circle_error_ = 0, orientation_error_ = 0;
  PredicateCounts counts_;
};

} // namespace calotte::delaunay_detail
