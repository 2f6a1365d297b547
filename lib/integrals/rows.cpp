// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/rows.h"

#include "exact/predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace calotte::integrals_detail {

namespace {

Batch make_batch(std::span<const Triple> triangles, std::size_t first) {
  Batch batch;
  batch.count = std::min(lanes, triangles.size() - first);
  batch.locals = triangles.data() + first;
  return batch;
}

/// The corners of a lane's triangle.
const Triple& locals_of(const Batch& batch, std::size_t lane) {
  return batch.locals[std::min(lane, batch.count - 1)];
}

/// Gathers four corners at a time. A column of x is read with the double that follows it.
/// \param triangle the triangle of a lane.
template <class Triangle>
CALOTTE_INLINE void gather_by(const Triangle& triangle, const Vec3* x,
                              std::array<Rows3, 3>& corner) {
  for (std::size_t lane = 0; lane < lanes; lane += 4)
    for (std::size_t v = 0; v < 3; ++v) {
      const auto at = [&](std::size_t k) { return x + triangle(lane + k)[v]; };
      Quad unused;
      put_columns({at(0), at(1), at(2), at(3)}, lane, corner[v], unused);
    }
}

CALOTTE_VECTOR_WIDTHS
void gather_corners(const Triple* locals, std::size_t count, const Vec3* x,
                    std::array<Rows3, 3>& corner) {
  if (count == lanes)
    gather_by([&](std::size_t lane) { return locals[lane]; }, x, corner);
  else
    gather_by([&](std::size_t lane) { return locals[std::min(lane, count - 1)]; }, x, corner);
}

} // namespace

Batch gather(const SphericalTriangles&, std::span<const Triple> triangles, const Array<Vec3>& x,
             std::size_t first) {
  Batch batch = make_batch(triangles, first);
  gather_corners(batch.locals, batch.count, x.begin(), batch.corner);
  return batch;
}

Batch gather(const FlatTriangles& plane, std::span<const Triple> triangles, const Array<Vec3>& x,
             std::size_t first) {
  Batch batch = make_batch(triangles, first);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Triple& t = locals_of(batch, lane);
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3 apart = plane.space.offset(x[t[0]], x[t[v]]);
      put(apart, batch.corner[v], lane);
    }
  }
  return batch;
}

void gather_density(const Array<double>& rho, Batch& batch) {
  for (std::size_t lane = 0; lane < lanes; ++lane)
    for (std::size_t v = 0; v < 3; ++v)
      batch.rho[v][lane] = rho[locals_of(batch, lane)[v]];
}

namespace {

/// The input of the clearance of a triangle abc.
struct Triangle {
  Vec3 ab, ac;
  double height;
  double at_a, at_b, at_c;       ///< products of the two sides there, positive at acute angles
  double long_a, long_b, long_c; ///< |b-c|^2/4 and so on
  double cot_a;

  CALOTTE_INLINE double least() const {
    const double ab_least = at_a < at_b ? at_a : at_b, c_least = at_c < height ? at_c : height;
    return ab_least < c_least ? ab_least : c_least;
  }
};

/// The product of a corner's two sides is positive if its angle is acute. It errs by some 8
/// roundoffs of itself, and stored vectors differ from unit ones by 5: the margin exceeds both, for
/// sides of any length. The same bound holds for the normal's product.
struct SphericalClearance {
  CALOTTE_INLINE static double height(const Vec3& normal, const Vec3& a) { return dot(normal, a); }
  CALOTTE_INLINE double operator()(const Triangle& t) const {
    constexpr double margin = 1e-14, apart_scale = margin / antipodal;
    const double long_ab = t.long_a > t.long_b ? t.long_a : t.long_b;
    const double apart = apart_scale * (1 - (long_ab > t.long_c ? long_ab : t.long_c));
    const double least = t.least();
    return (least < apart ? least : apart) - margin;
  }
};

/// Offsets err by up to e = 4u M each, M the largest coordinate, and their products by 2 e times
/// their size.
struct FlatClearance {
  double largest, radius2; ///< the limit of the circumradius, see PlaneSigns

  CALOTTE_INLINE static double height(const Vec3& normal, const Vec3&) { return normal.z; }
  CALOTTE_INLINE double operator()(const Triangle& t) const {
    const double extent = size(t.ab) + size(t.ac);
    const double clearance = t.least() - 32 * roundoff * (largest + extent) * extent;
    return t.long_a * (1 + t.cot_a * t.cot_a) < radius2 ? clearance : -1;
  }
  CALOTTE_INLINE static double size(const Vec3& v) { return std::abs(v.x) + std::abs(v.y); }
};

template <class Clearance>
CALOTTE_VECTOR_WIDTHS bool compute_rows(const Clearance& given, const Batch& batch,
                                        TriangleRows& out) {
  const Clearance clearance_of = given; // writing to rows cannot change it
  std::int64_t unclear = 0;
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3 a = at(batch.corner[0], lane), b = at(batch.corner[1], lane),
               c = at(batch.corner[2], lane);
    const Vec3 ab = b - a, bc = c - b, ac = c - a;
    const Vec3 normal = cross(ab, bc);
    const double scale = 1 / std::sqrt(dot(normal, normal));
    Triangle t{ab,
               ac,
               Clearance::height(normal, a),
               dot(ac, ab),
               -dot(ab, bc),
               dot(bc, ac),
               0.25 * dot(bc, bc),
               0.25 * dot(ac, ac),
               0.25 * dot(ab, ab),
               0};
    t.cot_a = t.at_a * scale;
    put({t.long_a, t.long_b, t.long_c}, out.quarter, lane);
    put({t.cot_a, t.at_b * scale, t.at_c * scale}, out.cotangent, lane);
    put(normal, out.normal, lane);
    out.scale[lane] = scale;
    out.height[lane] = t.height;
    const double clearance = clearance_of(t);
    out.clearance[lane] = clearance;
    unclear |= clearance > 0 ? 0 : 1;
  }
  return unclear == 0;
}

CALOTTE_VECTOR_WIDTHS
void spherical_centres(const TriangleRows& rows, CentreRows& out) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double scale = rows.scale[lane], distance = rows.height[lane] * scale;
    out.distance[lane] = distance;
    put((distance * scale) * at(rows.normal, lane), out.centre, lane);
  }
}

/// Sets the circumcentres, from the middle of the first edge, perpendicular to it.
CALOTTE_VECTOR_WIDTHS
void flat_centres(const Batch& batch, const TriangleRows& rows, CentreRows& out) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3 b = at(batch.corner[1], lane); // the first corner is 0
    const double cot = rows.cotangent[2][lane];
    out.distance[lane] = 0;
    put({0.5 * (b.x - cot * b.y), 0.5 * (b.y + cot * b.x), 0}, out.centre, lane);
  }
}

} // namespace

// A function with versions for several vector widths would be exported, whatever its visibility.
bool triangle_rows(const SphericalTriangles&, const Batch& batch, TriangleRows& out) {
  return compute_rows(SphericalClearance{}, batch, out);
}

bool triangle_rows(const FlatTriangles& plane, const Batch& batch, TriangleRows& out) {
  const double half = std::min(plane.space.period().x, plane.space.period().y) / 2;
  const double radius2 = half > 0 ? half * half / 4 : std::numeric_limits<double>::infinity();
  return compute_rows(FlatClearance{plane.largest, radius2}, batch, out);
}

CentreRows centre_rows(const SphericalTriangles&, const Batch&, const TriangleRows& rows) {
  CentreRows out;
  spherical_centres(rows, out);
  return out;
}

CentreRows centre_rows(const FlatTriangles&, const Batch& batch, const TriangleRows& rows) {
  CentreRows out;
  flat_centres(batch, rows, out);
  return out;
}

} // namespace calotte::integrals_detail
