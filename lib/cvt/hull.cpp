// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/hull.h"

#include "base/points.h"
#include "base/vec3.h"
#include "density/demanded_spacing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {
namespace {

/// A row of points outside the boundary, at a distance of some spacings, and at half of that
/// distance from each other.
class RowOutside {
public:
  /// \param spacings distance from the boundary.
  RowOutside(const SphericalOutline& outline, const DemandedSpacing& demand, double spacings)
      : outline_(outline), demand_(demand), spacings_(spacings) {}

  std::vector<Vec3> all() {
    const auto& edges = outline_.edges();
    std::size_t ring = 0; // its first edge
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Vec3 left = left_of(edges[e]);
      walk(edges[e], left);
      const bool last = e + 1 == edges.size() || !same(edges[e].to, edges[e + 1].from);
      add_corner(edges[e].to, left, left_of(edges[last ? ring : e + 1]));
      ring = last ? e + 1 : ring;
    }
    return std::move(points_);
  }

private:
  static constexpr double farthest = 0.4; ///< radians; beyond, the far hull suffices

  static bool same(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
  static Vec3 left_of(const SphericalOutline::Edge& edge) {
    const Vec3 left = cross(edge.from, edge.to);
    return (1 / norm(left)) * left;
  }

  /// Fills the gap at a convex corner.
  void add_corner(const Vec3& x, const Vec3& before, const Vec3& after) {
    constexpr double slight = 0.88; // cosine of half a radian
    if (dot(before, after) < slight)
      add(x, before + after);
  }

  void walk(const SphericalOutline::Edge& edge, const Vec3& left) {
    const Vec3 along = cross(left, edge.from);
    const double length = 2 * std::asin(std::min(1.0, norm(edge.to - edge.from) / 2));
    double at = next_ - since_;
    for (; at < length; at += next_) {
      const Vec3 x = std::cos(at) * edge.from + std::sin(at) * along;
      next_ = std::min(spacings_ / 2 * demand_.at(x), farthest);
      add(x, left);
      since_ = -at;
    }
    since_ += length;
  }

  void add(const Vec3& x, const Vec3& left) {
    const double distance = spacings_ * demand_.at(x);
    if (!(distance < farthest))
      return;
    const Vec3 point = std::cos(distance) * x - (std::sin(distance) / norm(left)) * left;
    bool near = outline_.side(point) != Side::outside;
    outline_.for_each_edge_near((1 / norm(point)) * point, 0.7 * distance,
                                [&](const SphericalOutline::Edge&) { near = true; });
    if (!near)
      points_.push_back((1 / norm(point)) * point);
  }

  const SphericalOutline& outline_;
  const DemandedSpacing& demand_;
  double spacings_;
  double since_ = 0, next_ = 0;
  std::vector<Vec3> points_;
};

} // namespace

Points3 hull_rows(const Surface& surface, const Density& density, std::int64_t generators) {
  const SphericalOutline& outline = *outline_of<Sphere>(surface);
  constexpr double nearest = 4; // spacings
  const DemandedSpacing demand(surface, density, static_cast<double>(generators));
  std::vector<Vec3> points;
  std::vector<Vec3> row = RowOutside(outline, demand, nearest).all();
  for (double spacings = 2 * nearest; !row.empty(); spacings *= 2) {
    points.insert(points.end(), row.begin(), row.end());
    row = RowOutside(outline, demand, spacings).all();
  }
  Points3 rows(3, std::ssize(points));
  for (std::size_t k = 0; k < points.size(); ++k)
    set_column(rows, static_cast<Eigen::Index>(k), points[k]);
  return rows;
}

} // namespace calotte::cvt_detail
