// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "base/require.h"
#include "domain/spherical_outline.h"
#include "domain/surface.h"
#include "domain/tangent_outline.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace domain_detail;
namespace bg = boost::geometry;

using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point, false, false>; ///< counter-clockwise, not closed
using MultiPolygon = bg::model::multi_polygon<Polygon>;

/// The stereographic projection from the point opposite to a centre. Its scale is 1 at the centre
/// and larger elsewhere.
class Stereographic {
public:
  explicit Stereographic(const Vec3& centre) : plane_(centre) {}

  Point projected(const Vec3& x) const {
    const Vec2 u = (2 / (1 + plane_.height(x))) * plane_.along(x);
    return {u.x, u.y};
  }
  Vec3 lifted(const Point& point) const {
    const Vec2 u{point.x() / 2, point.y() / 2};
    const double square = dot(u, u);
    return (1 / (1 + square)) * ((1 - square) * plane_.at() + 2 * plane_.tangent(u));
  }
  /// The scale of the projection at an angle from the centre.
  static double scale(double angle) {
    const double tangent = std::tan(angle / 2);
    return 1 + tangent * tangent;
  }

private:
  TangentPlane plane_;
};

/// The mean direction of a boundary, weighted by length.
Vec3 centre_of(const SphericalOutline& outline) {
  Vec3 sum{0, 0, 0};
  for (const SphericalOutline::Edge& edge : outline.edges())
    sum = sum + norm(edge.to - edge.from) * (edge.from + edge.to);
  return norm(sum) > 0 ? (1 / norm(sum)) * sum : outline.edges().front().from;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return 2 * std::atan2(norm(a - b), norm(a + b));
}

/// The projection of a ring's corners, and of points on its arcs at most 1/100 apart, so that
/// straight lines between them are near the arcs.
Polygon::ring_type projected(const Points3& ring, const Stereographic& map) {
  constexpr double step = 0.01;
  Polygon::ring_type out;
  for (Eigen::Index k = 0; k < ring.cols(); ++k) {
    const Eigen::Vector3d a = ring.col(k).normalized(),
                          b = ring.col((k + 1) % ring.cols()).normalized();
    const int parts = 1 + static_cast<int>((a - b).norm() / step);
    for (int p = 0; p < parts; ++p) {
      const double share = static_cast<double>(p) / parts;
      const Eigen::Vector3d x = ((1 - share) * a + share * b).normalized();
      out.push_back(map.projected({x.x(), x.y(), x.z()}));
    }
  }
  return out;
}

/// Outer rings with the holes inside them.
MultiPolygon polygons_of(const Surface::Rings& rings, const Stereographic& map) {
  MultiPolygon polygons;
  std::vector<Polygon::ring_type> holes;
  for (const DoubleMatrix& ring : rings) {
    Polygon::ring_type line = projected(ring, map);
    if (bg::area(line) > 0) {
      polygons.emplace_back();
      polygons.back().outer() = std::move(line);
    } else {
      holes.push_back(std::move(line));
    }
  }
  for (Polygon::ring_type& hole : holes)
    for (Polygon& polygon : polygons)
      if (bg::within(hole.front(), polygon.outer())) {
        polygon.inners().push_back(std::move(hole));
        break;
      }
  return polygons;
}

/// \param least minimum distance between corners; nearer corners, which rounding could merge, are
/// removed.
Points3 lifted(const Polygon::ring_type& ring, double least, const Stereographic& map) {
  Polygon::ring_type corners;
  for (const Point& point : ring)
    if (corners.empty() || (bg::distance(point, corners.back()) > least &&
                            bg::distance(point, corners.front()) > least))
      corners.push_back(point);
  Points3 out(3, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t k = 0; k < corners.size(); ++k)
    base_detail::set_column(out, static_cast<Eigen::Index>(k), map.lifted(corners[k]));
  return out;
}

} // namespace

Surface widened(const Surface& surface, double distance) {
  constexpr double farthest = 2; // radians from the centre, where distances are enlarged 3.4 times
  base_detail::require(distance > 0 && std::isfinite(distance),
                       "the distance is {}; give a positive angle in radians", distance);
  require_sphere(surface, "a widened region is");
  if (!surface.is_bounded())
    return surface;
  const SphericalOutline& outline = *outline_of<Sphere>(surface);
  const Vec3 centre = centre_of(outline);
  double reach = 0;
  for (const SphericalOutline::Edge& edge : outline.edges())
    reach = std::max(reach, angle_between(centre, edge.from));
  reach += distance;
  if (reach > farthest || outline.side(-1 * centre) != Side::outside)
    return {};
  const Stereographic map(centre);
  MultiPolygon wide;
  constexpr double inscribed = 1.02; // corners become polygons, here of 24 corners for a circle
  const double offset = inscribed * distance * Stereographic::scale(reach);
  bg::buffer(polygons_of(surface.rings(), map), wide,
             bg::strategy::buffer::distance_symmetric<double>(offset),
             bg::strategy::buffer::side_straight(), bg::strategy::buffer::join_round(24),
             bg::strategy::buffer::end_flat(), bg::strategy::buffer::point_circle(24));
  const double least = 1e-3 * offset;
  Surface::Rings rings;
  for (const Polygon& polygon : wide) {
    rings.push_back(lifted(polygon.outer(), least, map));
    for (const Polygon::ring_type& hole : polygon.inners())
      rings.push_back(lifted(hole, least, map));
  }
  return UncheckedSurface::of_sphere(std::move(rings));
}

} // namespace calotte
