// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/plane_chart.h"
#include "delaunay/regions.h"
#include "delaunay/room.h"
#include "delaunay/sphere_chart.h"
#include "delaunay/triangulate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

/// The cull test (Jacobsen et al., 2013, Eq. 1 and Sect. 3.2): true if the circumcap of a triangle
/// lies in the part of the domain of which a region has all sites. It runs in doubles with bounded
/// errors.
namespace calotte::delaunay_detail {

template <class Chart> using FaceOf = typename Triangulation<Chart>::Face;

/// Error of a triangle's normal (b - a) x (c - a), for each unit of its longest side: a difference
/// of unit vectors errs by 10 roundoffs and its own rounding, the cross product by two such times a
/// side.
inline constexpr double normal_error = 50 * roundoff;

/// The flat triangle's normal (b - a) x (c - a), not normalised.
inline Vec3 normal_of(FaceOf<SphereChart> face) { return face->circle.normal; }
inline Vec3 normal_of(FaceOf<PlaneChart> face) {
  return cross(face->vertex(1)->point.unit - face->vertex(0)->point.unit,
               face->vertex(2)->point.unit - face->vertex(0)->point.unit);
}

/// True if the normal of the triangle points outward, so that its circumcap is less than a
/// hemisphere.
inline bool is_below_hemisphere(FaceOf<SphereChart> face) { return face->circle.offset > 0; }
inline bool is_below_hemisphere(FaceOf<PlaneChart>) { return true; }

/// A triangle's circumcircle, in doubles.
struct Circumcircle {
  Vec3 normal;   ///< as normal_of
  double area;   ///< its norm
  double radius; ///< of the flat triangle; on the sphere the sine of the cap's
  double error;  ///< of the normal, relative
};

template <class Face> Circumcircle circumcircle(Face face) {
  const Vec3 &a = face->vertex(0)->point.unit, &b = face->vertex(1)->point.unit,
             &c = face->vertex(2)->point.unit;
  const Vec3 ab = b - a, ac = c - a, bc = c - b;
  const double ab2 = dot(ab, ab), ac2 = dot(ac, ac), bc2 = dot(bc, bc);
  const Vec3 normal = normal_of(face);
  const double area = norm(normal);
  const double longest = std::sqrt(std::max({ab2, ac2, bc2}));
  return {normal, area, std::sqrt(ab2 * ac2 * bc2) / (2 * area), normal_error * longest / area};
}

/// True if a ball around an owned vertex that contains the circumcap is covered. The radius of the
/// ball is the chord of the cap's diameter, 2 sin r, and sin r = |ab||ac||bc| / (2 |q|), q = ab x
/// ac. Most triangles pass, so the test has no roots or quotients; a relative error of 1e-3 in q
/// moves the radius by less than the margin of 2%.
/// \pre one of the vertices is owned.
template <class Face> bool is_within_depth(Face face) {
  const auto a = face->vertex(0), b = face->vertex(1), c = face->vertex(2);
  const float depth = std::max({a->depth, b->depth, c->depth});
  assert(depth >= 0);
  const Vec3 ab = b->point.unit - a->point.unit, ac = c->point.unit - a->point.unit,
             bc = c->point.unit - b->point.unit;
  const double ab2 = dot(ab, ab), ac2 = dot(ac, ac), bc2 = dot(bc, bc);
  const Vec3 normal = normal_of(face);
  const double area2 = dot(normal, normal);
  constexpr double most_error = 1e-3, error = normal_error / most_error;
  return is_below_hemisphere(face) && area2 > error * error * std::max({ab2, ac2, bc2}) &&
         1.04 * ab2 * ac2 * bc2 < static_cast<double>(depth) * depth * area2;
}

/// True if the cap lies in all half-spaces: its highest point over each is cos(angle - r), the
/// angle from the cap's centre to the normal, or 1 if the cap contains the normal.
inline bool is_covered(FaceOf<SphereChart> face, const std::vector<HalfSpace>& covered) {
  const Circumcircle cap = circumcircle(face);
  if (!is_below_hemisphere(face) || !(cap.error < 1e-3) || cap.radius > 0.9)
    return false;
  const Vec3 centre = (1 / cap.area) * cap.normal;
  const double cosine = std::sqrt(1 - cap.radius * cap.radius);
  // The cap's centre errs by the normal's error e, and sin r by 1.6 e relative: by e for the
  // normal's length, by e/5 for each side, 10 roundoffs long. That moves r by 1.6 e tan r < 3.4 e.
  const double margin = 8 * cap.error + 1e-14;
  return std::all_of(covered.begin(), covered.end(), [&](const HalfSpace& h) {
    const double height = dot(centre, h.normal);
    if (height >= cosine)
      return false;
    // Near -1 the root turns a rounding error of the height into 1e-8; the result must not be too
    // small.
    const double across = std::sqrt(1 - height * height + 1e-14);
    return height * cosine + cap.radius * across + margin <= h.offset;
  });
}

/// True if the disc lies in all half-planes. With e the relative error of q, radius and centre, a +
/// ((ab . ab) ac - (ac . ac) ab) turned / 2q, err by some e times the radius and longest side.
inline bool is_covered(FaceOf<PlaneChart> face, const std::vector<HalfSpace>& covered) {
  const Circumcircle disc = circumcircle(face);
  if (!(disc.error < 1e-3) || disc.radius > PlaneChart::diameter)
    return false;
  const Vec3& a = face->vertex(0)->point.unit;
  const Vec3 ab = face->vertex(1)->point.unit - a, ac = face->vertex(2)->point.unit - a;
  const Vec3 across = dot(ab, ab) * ac - dot(ac, ac) * ab;
  const Vec3 centre = a + (1 / (2 * disc.normal.z)) * Vec3{across.y, -across.x, 0};
  const double margin = 16 * disc.error * disc.radius + 1e-14;
  return std::all_of(covered.begin(), covered.end(), [&](const HalfSpace& h) {
    return dot(centre, h.normal) + disc.radius + margin <= h.offset;
  });
}

} // namespace calotte::delaunay_detail
