// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/slivers.h"

#include "base/elementary.h"
#include "exact/vec3_of.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

namespace calotte::integrals_detail {
namespace {

/// The admissible relative error of a cotangent.
constexpr double tolerance = 0x1p-34;

using PreciseVec3 = Vec3Of<mpf_class>;

mpf_class length(const PreciseVec3& a) { return sqrt(dot(a, a)); }

/// The number of bits that resolve the determinant of three directions, a product of their last
/// bits, relative to products of lengths.
mp_bitcnt_t precision_of(const std::array<Vec3, 3>& corners) {
  int least = 0;
  for (const Vec3& x : corners)
    for (const double component : {x.x, x.y, x.z})
      if (component != 0)
        least = std::min(least, std::ilogb(component));
  return static_cast<mp_bitcnt_t>(512 - 4 * least);
}

/// x/|x|
PreciseVec3 normalised(const PreciseVec3& x) {
  const mpf_class norm = length(x);
  return {x.x / norm, x.y / norm, x.z / norm};
}

PreciseVec3 direction(const Vec3& x, mp_bitcnt_t precision) {
  return normalised(
      {mpf_class(x.x, precision), mpf_class(x.y, precision), mpf_class(x.z, precision)});
}

Vec3 rounded(const PreciseVec3& a) { return {a.x.get_d(), a.y.get_d(), a.z.get_d()}; }

/// True if rows in doubles do not resolve a triangle. Corners lie up to a roundoff above or below
/// the sphere, which tilts the triangle by that over its altitude. The tilt changes the normal's
/// length by its square and, as far as the normal is already tilted, in proportion. Where the
/// circumcap is nearly a hemisphere, the arc to its centre follows from its cosine alone. Squares
/// of lengths may underflow to a tilt that is NaN.
bool is_sliver(const TriangleRows& rows, std::size_t lane) {
  constexpr double roundoff = 0x1p-52;
  const double a = rows.quarter[0][lane], b = rows.quarter[1][lane], c = rows.quarter[2][lane];
  const double longest = std::max({a, b, c});
  const double tilt = 2 * roundoff * std::sqrt(longest) * rows.scale[lane];
  const double circumradius = 4 * std::sqrt(a) * std::sqrt(b) * std::sqrt(c) * rows.scale[lane];
  const bool hemisphere = rows.height[lane] * rows.scale[lane] < 0x1p-20;
  return !(tilt * (tilt + circumradius) <= tolerance) || hemisphere || 1 - longest < antipodal;
}

/// \param height of the circumcentre's direction over the triangle's corners: the cosine of the
///        circumcap's radius.
HalfEdge precise_half_edge(const PreciseVec3& a, const PreciseVec3& b, const mpf_class& cotangent,
                           const mpf_class& height) {
  const mpf_class sine = 0.5 * length(a - b), cosine = 0.5 * length(a + b);
  if (cosine == 0) // a mesh that is no longer Delaunay
    return {1, 0, 0, 0};
  const mpf_class sine_of_arc = sine * cotangent / cosine;
  const mpf_class cosine_of_arc = height > 0 ? mpf_class(height / cosine) : mpf_class(0);
  const double tangent = mpf_class(sine_of_arc / (1 + cosine_of_arc)).get_d();
  return {sine.get_d(), cosine.get_d(), 2 * arc_tangent(tangent), tangent};
}

/// Sets the rows of a sliver, see triangle_rows(). False if the corners span no triangle: a mesh
/// that is no longer Delaunay may have such corners.
bool resolve(const Batch& batch, Sliver& sliver, TriangleRows& rows) {
  const std::size_t lane = sliver.lane;
  const std::array<Vec3, 3> given{at(batch.corner[0], lane), at(batch.corner[1], lane),
                                  at(batch.corner[2], lane)};
  if (!std::all_of(given.begin(), given.end(), is_finite))
    return false;
  const mp_bitcnt_t precision = precision_of(given);
  const std::array<PreciseVec3, 3> x{direction(given[0], precision), direction(given[1], precision),
                                     direction(given[2], precision)};
  const std::array<PreciseVec3, 3> side{x[1] - x[2], x[2] - x[0], x[0] - x[1]};
  const PreciseVec3 normal = cross(side[2], side[0]);
  const mpf_class area = length(normal), height = dot(normal, x[0]);
  if (area == 0)
    return false;
  for (std::size_t v = 0; v < 3; ++v) {
    const std::size_t next = (v + 1) % 3, previous = (v + 2) % 3;
    const mpf_class cotangent = -dot(side[next], side[previous]) / area;
    rows.quarter[v][lane] = 0.25 * dot(side[v], side[v]).get_d();
    rows.cotangent[v][lane] = cotangent.get_d();
    sliver.side[v] = rounded(normalised(side[v]));
    sliver.half[v] = precise_half_edge(x[next], x[previous], cotangent, height / area);
  }
  put(rounded(normal), rows.normal, lane);
  rows.scale[lane] = 1 / area.get_d();
  rows.height[lane] = height.get_d();
  return true;
}

} // namespace

std::vector<Sliver> resolve_slivers(const Batch& batch, TriangleRows& rows) {
  std::vector<Sliver> slivers;
  for (std::size_t lane = 0; lane < batch.count; ++lane)
    if (Sliver sliver{lane, {}, {}};
        !(rows.clearance[lane] > 0) && is_sliver(rows, lane) && resolve(batch, sliver, rows))
      slivers.push_back(sliver);
  return slivers;
}

} // namespace calotte::integrals_detail
