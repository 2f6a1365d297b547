// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "base/triangle.h"
#include "curve/box_tree.h"
#include "exact/space.h"
#include "mesh/convex_boundary.h"
#include "mesh/room.h"

#include <calotte/mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace calotte::mesh_detail {

/// The predicates of positions and a mesh, for Locator and interpolation: the side of an edge on
/// which a position is, whether it is in a circle, and which site is nearer. All are exact.
template <Space S> class SeenMesh {
public:
  using Position = typename S::Position;
  static constexpr int copies = S::copies;

  /// \pre the mesh has triangles.
  SeenMesh(const Mesh& mesh, const S& space) : mesh_(mesh), space_(space) {}

  const Mesh& mesh() const { return mesh_; }

  /// The position of x; in a box its copy inside. On the sphere x has any norm.
  Position position(const Vec3& x) const { return space_.position(x); }
  /// The k-th of the copies of a position around the box. Without periods there is only one.
  Position copy(const Position& p, int k) const { return space_.copy(p, k); }
  Vec3 coordinates(const Position& p) const { return space_.coordinates(p); }
  Vec3 vertex(std::int32_t site) const { return coordinates(position(at(site))); }
  /// Whether the boundary is convex: a walk that leaves the mesh does not return, and sites at the
  /// boundary have all of their neighbours. On the sphere only a closed mesh has this property:
  /// beside a part of the sphere is its far side.
  bool has_convex_boundary() const {
    if constexpr (S::on_sphere)
      return mesh_.closed();
    else
      return mesh_.closed() || (mesh_.surface.period().isZero() && is_convex(mesh_));
  }

  /// The sign of the side of the edge across from a triangle's vertex on which p lies: 1 inside.
  int side(std::int64_t t, int v, const Position& p) const {
    const Corners corner = corners(t, p);
    return space_.orientation(following(corner, v), preceding(corner, v), p);
  }
  /// -1 if site a is nearer to p than b, 1 if b is.
  int compare(const Position& p, std::int32_t a, std::int32_t b) const {
    return a == b ? 0 : space_.compare_distances(p, near(a, p), near(b, p));
  }
  /// Positive if p is inside a triangle's circumcircle.
  int in_circle(std::int64_t t, const Position& p) const {
    const Corners corner = corners(t, p);
    return space_.in_circle(corner[0], corner[1], corner[2], p);
  }

  /// The points of a site and of p, in a common frame.
  Vec3 seen(std::int32_t site, const Position& p) const { return space_.seen(near(site, p), p); }
  Vec3 seen(const Position& p) const { return space_.seen(p, p); }

  /// The area, up to a factor, of the triangle of p and the edge across from a vertex.
  double area(std::int64_t t, int v, const Position& p) const {
    const Corners corner = corners(t, p);
    return S::area_term(coordinates(p), coordinates(following(corner, v)),
                        coordinates(preceding(corner, v)));
  }

  /// The approximate distance of a position from a triangle; <= 0 inside.
  double distance_outside(std::int64_t t, const Position& p) const {
    const Corners corner = corners(t, p);
    double farthest = -std::numeric_limits<double>::infinity();
    for (int v = 0; v < 3; ++v) {
      const Vec3 from = coordinates(following(corner, v)), to = coordinates(preceding(corner, v));
      farthest = std::max(farthest, -area(t, v, p) / norm(to - from));
    }
    return farthest;
  }

  Box3 box(std::int64_t t) const {
    const Corners corner = corners(t, position(at(mesh_.triangles(0, t))));
    const std::array<Vec3, 3> x{coordinates(corner[0]), coordinates(corner[1]),
                                coordinates(corner[2])};
    if constexpr (S::on_sphere)
      return box_of_cap(x);
    Box3 box;
    for (const Vec3& c : x)
      box = joined(box, {c, c});
    return box;
  }

private:
  using Corners = std::array<Position, 3>;

  const Vec3& at(std::int32_t site) const { return column(mesh_.points, site); }
  /// The copy of a site that is nearest to a position; one of them where several are equally near.
  Position near(std::int32_t site, const Position& p) const { return space_.near(at(site), p); }
  /// The corners of a triangle: the copy of the first that is nearest to p, and the copies of the
  /// others that are nearest to the first.
  Corners corners(std::int64_t t, const Position& p) const {
    const Position first = near(mesh_.triangles(0, t), p);
    return {first, near(mesh_.triangles(1, t), first), near(mesh_.triangles(2, t), first)};
  }
  static const Position& following(const Corners& corner, int v) {
    return corner[static_cast<std::size_t>(next_vertex(v))];
  }
  static const Position& preceding(const Corners& corner, int v) {
    return corner[static_cast<std::size_t>(previous_vertex(v))];
  }

  /// A triangle of the sphere lies in the cap around its mean direction that its vertices span.
  static Box3 box_of_cap(const std::array<Vec3, 3>& x) {
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

  const Mesh& mesh_;
  S space_;
};

} // namespace calotte::mesh_detail
