// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/room.h"
#include "delaunay/sites.h"
#include "exact/plane_predicates.h"
#include "exact/predicates.h"

#include <algorithm>
#include <cmath>

namespace calotte::delaunay_detail {

/// The plane as seen from one region, the second model of a Chart (see sphere_chart.h). The
/// projection is the identity. The doubles of a point filter both signs; the exact predicates on
/// the given coordinates decide the rest.
class PlaneChart {
public:
  struct Point {
    Vec3 unit;   ///< in the sites' frame, z = 0; rounded
    double x, y; ///< given, times the frame's power of two: exact but for underflow, an image's
                 ///< rounded
    std::int32_t site;
  };

  /// The triangle lifted onto the paraboloid |x - a|^2: the normal (b - a) x (c - a) there, whose
  /// third coordinate is twice the flat triangle's area.
  struct Circle {
    Vec3 normal;
  };

  /// The distance that no two points in the frame exceed.
  static constexpr double diameter = 2.83;

  static Surface surface() { return Surface::plane(); } ///< of the mesh; of images, too

  /// Views all sites.
  explicit PlaneChart(const Sites& sites) : PlaneChart(sites, {0, 0, 0}, diameter) {}

  /// `reach` bounds the distance from the centre to the sites of a region, in the sites' frame.
  PlaneChart(const Sites& sites, const Vec3& centre, double reach)
      : sites_(&sites), centre_(centre) {
    widen(reach);
  }

  static bool has_point(std::int64_t) { return true; }
  static constexpr bool has_all_points(double) { return true; }

  /// Prefetches the data that point() reads: the given coordinates are in input order.
  void expect(std::int64_t rank) const { __builtin_prefetch(&sites_->given(sites_->id[rank])); }

  /// The chart's point of a site; widens the error bounds if the site exceeds them.
  Point point(std::int64_t rank);

  const PredicateCounts& counts() const { return counts_; }

  int orientation(const Point& a, const Point& b, const Point& c) {
    const double value = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (value > orientation_error_)
      return 1;
    if (value < -orientation_error_)
      return -1;
    return orientation_beyond_static(a, b, c);
  }

  bool between(const Point& a, const Point& p, const Point& b) const {
    return exact_detail::between(sites_->frame->period, image(a), image(p), image(b));
  }

  static Circle circle(const Point& a, const Point& b, const Point& c) {
    const double px = b.x - a.x, py = b.y - a.y, qx = c.x - a.x, qy = c.y - a.y;
    const double p2 = px * px + py * py, q2 = qx * qx + qy * qy;
    return {{py * q2 - p2 * qy, p2 * qx - px * q2, px * qy - py * qx}};
  }

  /// \param circle that of a, b, c.
  int in_circle(const Circle& circle, const Point& a, const Point& b, const Point& c,
                const Point& d) {
    const double x = d.x - a.x, y = d.y - a.y;
    const double value =
        -(circle.normal.x * x + circle.normal.y * y + circle.normal.z * (x * x + y * y));
    if (value > in_circle_error_)
      return 1;
    if (value < -in_circle_error_)
      return -1;
    // The bound of widen() by this triangle's size L and the offset's s. If sites are far denser
    // along a region than across it, the static bound decides no sign. (L + s)^2 is at most 2 (L^2
    // + s^2), and s (L + s) at most 3/4 of that, which needs no roots.
    const double size2 = std::max(square_distance(a, b), square_distance(a, c)),
                 both2 = 2 * (size2 + square_distance(a, d));
    double error = 61 * roundoff * size2 * both2 + least_error;
    if (image_error_ > 0)
      error += 50 * image_error_ * (std::sqrt(both2) + image_error_) * both2;
    if (value > error)
      return 1;
    if (value < -error)
      return -1;
    return in_circle_beyond_local(a, b, c, d);
  }

private:
  /// Bound on the underflow error of the scaled coordinates and their products, with a margin.
  static constexpr double least_error = 0x1p-900;

  static double square_distance(const Point& a, const Point& b) {
    return (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  }
  Vec2 given(const Point& a) const {
    const Vec3& p = sites_->given(a.site);
    return {p.x, p.y};
  }
  Image image(const Point& a) const {
    return periodic() ? sites_->images[static_cast<std::size_t>(a.site)] : Image{given(a), 0, 0};
  }
  bool periodic() const { return !sites_->images.empty(); }
  void widen(double reach);
  int orientation_beyond_static(const Point& a, const Point& b, const Point& c);
  int in_circle_beyond_local(const Point& a, const Point& b, const Point& c, const Point& d);

  const Sites* sites_;
  Vec3 centre_;
  double reach_ = 0;
  double in_circle_error_ = 0, orientation_error_ = 0;
  double image_error_ = 0; ///< of a point's coordinate in a periodic box
  PredicateCounts counts_;
};

} // namespace calotte::delaunay_detail
