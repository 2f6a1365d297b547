// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/planar_check.h"

#include "base/message.h"
#include "curve/hilbert.h"
#include "exact/space.h"
#include "mesh/edge_counts.h"

#include <algorithm>
#include <cmath>

namespace calotte {
namespace {

using base_detail::message;
using exact_detail::Image;
using exact_detail::Plane;
using exact_detail::roundoff;
using exact_detail::Vec2;
using mesh_detail::Area;
using mesh_detail::Proof;

std::string site_failure(const Mesh& mesh, std::int64_t site) {
  if (!(mesh.points(2, site) == 0))
    return message("site {} of the plane has a z that is not 0", site);
  const Eigen::Vector2d p = mesh.points.col(site).head<2>(), &period = mesh.surface.period();
  if (!p.allFinite())
    return message("site {} is not a place", site);
  const auto outside = p.array() < 0 || p.array() >= period.array();
  if (!(period.array() > 0 && outside).any())
    return {};
  return message("site {} is outside the periodic {}", site,
                 mesh.surface.is_box() ? "box" : "channel");
}

/// The power of two that brings the largest of the coordinates and periods to between 1/2 and 1.
int scale_of(const Mesh& mesh) {
  const double largest = mesh.points.size() > 0 ? mesh.points.cwiseAbs().maxCoeff() : 0;
  int exponent = 0;
  std::frexp(std::max(largest, mesh.surface.period().maxCoeff()), &exponent);
  return -exponent;
}

/// The area p x q / 2 of offsets whose coordinates err by `off` each.
///
/// With d the largest difference, a product of two errs by 2 d off + off^2 and by u d^2 in its
/// evaluation, as does their difference by 2 u d^2.
Area half_cross(const Vec2& p, const Vec2& q, double off) {
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(q.x), std::abs(q.y)});
  return {(p.x * q.y - p.y * q.x) / 2,
          2 * largest * off + off * off + 2 * roundoff * largest * largest};
}

/// A mesh in the plane, in a channel or in a periodic box. Predicates use the copies of sites
/// nearest to a site: the shift of the copy of b near a is the opposite of the shift of the copy of
/// a near b.
struct InPlane : mesh_detail::Faces {
  static constexpr const char* circle = "circle";

  const Mesh& mesh;
  Proof proof;
  Plane plane;
  Vec2 period; ///< 0 in a direction without one
  int scale;   ///< exponent, for areas

  explicit InPlane(const Mesh& given, Proof wanted = Proof::surface)
      : Faces(mesh_detail::faces_of(given)), mesh(given), proof(wanted),
        plane(given.surface.period()), period(plane.period()), scale(scale_of(given)) {}

  bool periodic() const { return period.x > 0 || period.y > 0; }
  bool is_box() const { return period.x > 0 && period.y > 0; }
  Vec2 given(std::int32_t site) const { return {mesh.points(0, site), mesh.points(1, site)}; }

  /// The number of periods to the nearest copy. Of two that are equally near it is the stored copy,
  /// unlike in Plane::near(): a triangle of points in the box that is exactly half as wide is valid
  /// as stored.
  static int boxes_to(double from, double to, double length) {
    if (!(length > 0))
      return 0;
    const double way = to - from;
    return way > length / 2 ? -1 : way < -length / 2 ? 1 : 0;
  }

  Image image(std::int32_t site, std::int32_t near) const {
    const Vec2 p = given(site), q = given(near);
    return {p, boxes_to(q.x, p.x, period.x), boxes_to(q.y, p.y, period.y)};
  }

  int orientation(std::int32_t a, std::int32_t b, std::int32_t c) const {
    return plane.orientation(image(a, a), image(b, a), image(c, a));
  }

  int in_circle(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
    return plane.in_circle_resolved(image(a, a), image(b, a), image(c, a), image(d, a));
  }

  const void* stored(std::int32_t site) const { return &mesh.points(0, site); }

  /// For a periodic box; an open mesh has no traversal.
  static constexpr int cube_faces = 1;
  curve_detail::CubePoint square(std::int32_t site) const {
    const Vec2 p = given(site);
    const double u = is_box() ? p.x / period.x : 0, v = is_box() ? p.y / period.y : 0;
    return {0, 2 * u - 1, 2 * v - 1};
  }

  /// The nearest copies lead from corner to corner and back to the first.
  std::string own_failure(std::int64_t t) const {
    int i = 0, j = 0;
    for (int k = 0; k < 3; ++k) {
      const Image next = image(vertex(t, k + 1), vertex(t, k));
      i += next.i;
      j += next.j;
    }
    return i == 0 && j == 0 ? std::string()
                            : triangle_name(*this, t) + " is wider than half of the period";
  }

  std::int64_t euler(std::int64_t) const { return periodic() ? 0 : 1; }

  double scaled(double x) const { return std::ldexp(x, scale); }

  /// The scaled offset from a site to another's nearest copy. It errs by two roundings of numbers
  /// of at most 2.
  Vec2 way(std::int32_t from, std::int32_t to) const {
    const Vec2 a = given(from);
    const Image b = image(to, from);
    return {scaled(b.site.x) - scaled(a.x) + b.i * scaled(period.x),
            scaled(b.site.y) - scaled(a.y) + b.j * scaled(period.y)};
  }

  /// Error of the coordinates of an offset: rounding, and the loss of scaling subnormal numbers.
  double error_of_way(const Vec2& p) const {
    return periodic() ? 4 * roundoff
                      : roundoff * std::max(std::abs(p.x), std::abs(p.y)) + 0x1p-1073;
  }

  Area scaled_area(std::int32_t a, std::int32_t b, std::int32_t c) const {
    const Vec2 p = way(a, b), q = way(a, c);
    return half_cross(p, q, std::max(error_of_way(p), error_of_way(q)));
  }

  /// Half the sum of the cotangents of the angles at c and d.
  double relative_length(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
    const auto cotangent = [&](std::int32_t p, std::int32_t from, std::int32_t to) {
      const Vec2 u = way(p, from), v = way(p, to);
      return (u.x * v.x + u.y * v.y) / (u.x * v.y - u.y * v.x);
    };
    return (cotangent(c, a, b) + cotangent(d, b, a)) / 2;
  }

  Area area(std::int64_t t) const { return scaled_area(vertex(t, 0), vertex(t, 1), vertex(t, 2)); }

  /// The area between an edge of a channel's boundary and a line along the period through the
  /// origin. The factors of the products are at most 2.
  Area beside(std::int32_t from, std::int32_t to) const {
    const Vec2 along = way(from, to), at = given(from);
    const double area = period.x > 0 ? -(scaled(at.y) + along.y / 2) * along.x
                                     : (scaled(at.x) + along.x / 2) * along.y;
    return {area, 32 * roundoff};
  }

  /// The extent of the sites along an axis, or the axis's period. It errs by one rounding.
  double extent(int axis) const {
    const auto row = mesh.points.row(axis);
    const double length = axis == 0 ? period.x : period.y;
    return length > 0 ? scaled(length) : scaled(row.maxCoeff()) - scaled(row.minCoeff());
  }

  /// The area of the box, of a channel between straight walls, or inside the boundary.
  Area whole() const {
    if (periodic() && proof == Proof::delaunay) {
      const double area = extent(0) * extent(1);
      return {area, 4 * roundoff * area};
    }
    if (is_box()) {
      const double box = scaled(period.x) * scaled(period.y);
      return {box, roundoff * box};
    }
    Area sum;
    std::int32_t corner = -1;
    std::int64_t edges = 0;
    for (std::int64_t t = 0; t < triangles(); ++t)
      for (int i = 0; i < 3; ++i)
        if (neighbour(t, i) < 0) {
          corner = corner < 0 ? vertex(t, i + 1) : corner;
          const Area part = periodic() ? beside(vertex(t, i + 1), vertex(t, i + 2))
                                       : scaled_area(corner, vertex(t, i + 1), vertex(t, i + 2));
          sum.value += part.value;
          sum.error += part.error;
          ++edges;
        }
    sum.error += static_cast<double>(edges) * roundoff * sum.value;
    return sum;
  }

  void set_area(double sum, CheckReport& result) const {
    result.area = std::ldexp(sum, -2 * scale);
    result.expected_area = std::ldexp(whole().value, -2 * scale);
  }

  /// The failure of the sum of areas. In a box with a boundary the sum may be smaller.
  std::string area_failure(const Area& area, const CheckReport& result) const {
    if (is_box() && result.boundary_edges > 0)
      return {};
    const Area all = whole();
    if (std::abs(all.value - area.value) <= 2 * (area.error + all.error))
      return {};
    const char* const covered = is_box() ? "periodic box" : periodic() ? "channel" : "hull";
    return message("the areas sum to {} of the area of the {}", area.value / all.value, covered);
  }
};

} // namespace

// Why local laws are enough. As on the sphere, the triangles cover without folds or branch points.
// In the plane the mesh bends at its boundary to the left alone: by Gauss and Bonnet each part has
// the characteristic 1, so there is one; and it is a convex one-sheeted polygon, as its boundary
// turns around once. In a periodic box each part covers the torus by as many sheets as the box goes
// into its area, so areas that sum to the box's leave one part of one sheet. In a channel a part
// that bends to the left alone has the characteristic 1, or 0 and straight walls: the sum 0 leaves
// the latter, and areas that sum to the channel between its outermost sites one of one sheet.
// Triangles narrower than half of the box lie in the plane without overlap, which is what
// in_circle() works in. Such a mesh with Delaunay edges is Delaunay.
CheckReport mesh_detail::check_in_plane(const Mesh& mesh, Proof proof,
                                        const ProgressCallback& progress) {
  return check_laws(
      mesh, [&](std::int64_t site) { return site_failure(mesh, site); },
      [&] { return InPlane(mesh, proof); }, proof, progress);
}

EdgeCounts mesh_detail::count_edges_in_plane(const Mesh& mesh) {
  return count_edges_of(InPlane(mesh));
}

} // namespace calotte
