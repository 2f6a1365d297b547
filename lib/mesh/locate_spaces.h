// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "base/triangle.h"
#include "curve/box_tree.h"
#include "curve/hilbert.h"
#include "exact/plane_predicates.h"
#include "exact/predicates.h"
#include "mesh/convex_boundary.h"
#include "mesh/planar_mesh.h"
#include "mesh/room.h"

#include <calotte/locate.h>
#include <calotte/types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

/// What locate() and interpolation ask of the space in which a mesh lives: on which side of an edge
/// a position is, whether it is in a circle, and which site is nearer, all exact.
namespace calotte::mesh_detail {

/// The sphere.
class OnSphere {
public:
  using Position = Vec3; ///< any norm
  static constexpr int copies = 1;

  OnSphere(const Mesh& mesh, const Points3Ref& positions) : mesh_(mesh), positions_(positions) {}

  Position position(std::int64_t i) const { return column(positions_, i); }
  Position copy(const Position& p, int) const { return p; }
  Vec3 coordinates(const Position& p) const { return normalised(p); }
  CubePoint square(const Vec3& coordinates) const { return to_cube(coordinates); }
  /// Whether a walk that leaves the mesh leaves it for good, and sites at the boundary have all
  /// neighbours that they have anywhere. Beside a part of the sphere there is its far side.
  bool has_convex_boundary() const { return mesh_.closed(); }
  Vec3 vertex(std::int32_t site) const { return normalised(at(site)); }

  /// The sign of the side of the edge across from a triangle's vertex on which p lies: 1 inside.
  int side(std::int64_t t, int v, const Position& p) const {
    return orientation(at(mesh_.triangles(next_vertex(v), t)),
                       at(mesh_.triangles(previous_vertex(v), t)), p);
  }
  int compare(const Position& p, std::int32_t a, std::int32_t b) const {
    return a == b ? 0 : compare_distances(p, at(a), at(b));
  }

  /// Positive if p is inside a triangle's circumcap.
  int in_circle(std::int64_t t, const Position& p) const {
    return exact_detail::in_circle(at(mesh_.triangles(0, t)), at(mesh_.triangles(1, t)),
                                   at(mesh_.triangles(2, t)), p);
  }
  /// A site as p sees it, and p itself: points of one frame.
  Vec3 seen(std::int32_t site, const Position&) const { return vertex(site); }
  Vec3 seen(const Position& p) const { return exact_detail::normalised(p); }

  /// The area, up to a factor, of the triangle of p and the edge across from a vertex.
  double area(std::int64_t t, int v, const Position& given) const {
    const Vec3 p = normalised(given);
    return dot(p, cross(vertex(mesh_.triangles(next_vertex(v), t)) - p,
                        vertex(mesh_.triangles(previous_vertex(v), t)) - p));
  }

  /// The triangle lies in the cap around its mean direction that its vertices span.
  Box3 box(std::int64_t t) const {
    const std::array<Vec3, 3> x{vertex(mesh_.triangles(0, t)), vertex(mesh_.triangles(1, t)),
                                vertex(mesh_.triangles(2, t))};
    const Vec3 sum = x[0] + x[1] + x[2];
    const double length = norm(sum);
    if (length < 0.1) // as large as a hemisphere, or nearly
      return {Box3::corner(-2), Box3::corner(2)};
    const Vec3 centre = (1 / length) * sum;
    const double radius =
        std::max({norm(x[0] - centre), norm(x[1] - centre), norm(x[2] - centre)}) + 1e-12;
    const Vec3 margin{radius, radius, radius};
    return {centre - margin, centre + margin};
  }

private:
  const Vec3& at(std::int32_t site) const { return column(mesh_.points, site); }

  const Mesh& mesh_;
  const Points3Ref& positions_;
};

/// The plane, or a plane that is periodic.
class InPlane {
public:
  using Position = Image;
  static constexpr int copies = 9;

  InPlane(const PlanarMesh& mesh, const Points2Ref& positions)
      : mesh_(mesh), positions_(positions), period_{mesh.period.x(), mesh.period.y()},
        low_(mesh.points.rowwise().minCoeff()) {
    const Eigen::Vector2d extent = mesh.points.rowwise().maxCoeff() - low_;
    half_ = std::max(extent.maxCoeff() / 2, std::numeric_limits<double>::min());
  }

  /// In a box, the copy inside.
  Position position(std::int64_t i) const {
    const Eigen::Vector2d p = positions_.col(i);
    return {{p.x(), p.y()}, boxes(p.x(), period_.x), boxes(p.y(), period_.y)};
  }
  /// The k-th of the copies around the box, which are one alone without periods.
  Position copy(const Position& p, int k) const {
    const int i = k % 3 - 1, j = k / 3 - 1;
    return {p.site, p.i + (period_.x > 0 ? i : 0), p.j + (period_.y > 0 ? j : 0)};
  }
  CubePoint square(const Vec3& x) const {
    const auto part = [&](double value, double low) {
      return std::clamp((value - low) / half_ - 1, -1.0, 1.0);
    };
    return {0, part(x.x, low_.x()), part(x.y, low_.y())};
  }
  bool has_convex_boundary() const {
    return mesh_.closed() || (mesh_.period.isZero() && is_convex(mesh_));
  }
  Vec3 coordinates(const Position& p) const {
    return {p.site.x + p.i * period_.x, p.site.y + p.j * period_.y, 0};
  }
  Vec3 vertex(std::int32_t site) const { return {mesh_.points(0, site), mesh_.points(1, site), 0}; }

  int side(std::int64_t t, int v, const Position& p) const {
    const std::array<Image, 3> corner = corners(t, p);
    return orientation(period_, corner[static_cast<std::size_t>(next_vertex(v))],
                       corner[static_cast<std::size_t>(previous_vertex(v))], p);
  }
  int compare(const Position& p, std::int32_t a, std::int32_t b) const {
    return a == b ? 0 : compare_distances(period_, p, near(a, p), near(b, p));
  }
  int in_circle(std::int64_t t, const Position& p) const {
    const std::array<Image, 3> corner = corners(t, p);
    return exact_detail::in_circle(period_, corner[0], corner[1], corner[2], p);
  }
  Vec3 seen(std::int32_t site, const Position& p) const {
    return coordinates(near(site, p)) - coordinates(p);
  }
  Vec3 seen(const Position&) const { return {0, 0, 0}; }
  double area(std::int64_t t, int v, const Position& p) const {
    const std::array<Image, 3> corner = corners(t, p);
    const Vec3 at = coordinates(p);
    return cross(coordinates(corner[static_cast<std::size_t>(next_vertex(v))]) - at,
                 coordinates(corner[static_cast<std::size_t>(previous_vertex(v))]) - at)
        .z;
  }
  Box3 box(std::int64_t t) const {
    const std::array<Image, 3> corner = corners(t, image(mesh_.triangles(0, t)));
    Box3 box;
    for (const Image& c : corner)
      box = joined(box, {coordinates(c), coordinates(c)});
    return box;
  }

private:
  static int boxes(double x, double period) {
    return period > 0 ? -static_cast<int>(std::floor(x / period)) : 0;
  }
  Image image(std::int32_t site) const {
    return {{mesh_.points(0, site), mesh_.points(1, site)}, 0, 0};
  }
  /// A site's copy that is nearest to a position, one of them where several are.
  Image near(std::int32_t site, const Position& p) const {
    Image at = image(site);
    const auto shift = [](double from, double to, double period) {
      return period > 0 ? static_cast<int>(std::round((to - from) / period)) : 0;
    };
    const Vec3 to = coordinates(p);
    at.i = shift(at.site.x, to.x, period_.x);
    at.j = shift(at.site.y, to.y, period_.y);
    return at;
  }
  /// Those of a triangle: the first as near as may be, the others as near to it.
  std::array<Image, 3> corners(std::int64_t t, const Position& p) const {
    const Image first = near(mesh_.triangles(0, t), p);
    return {first, near(mesh_.triangles(1, t), first), near(mesh_.triangles(2, t), first)};
  }

  const PlanarMesh& mesh_;
  const Points2Ref& positions_;
  Vec2 period_;
  Eigen::Vector2d low_;
  double half_ = 1; ///< of the longer side
};

/// As locate().
Locations locate_in_plane(const PlanarMesh& mesh, const base_detail::Points2Ref& positions);

} // namespace calotte::mesh_detail
